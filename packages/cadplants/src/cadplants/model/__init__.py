"""What a plant is: components, units, contacts, families of devices, standard sizes."""
