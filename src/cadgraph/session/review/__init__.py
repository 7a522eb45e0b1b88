"""What is most worth a look first: questions about labels and about the network, with answers to choose from."""
