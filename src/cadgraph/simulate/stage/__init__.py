"""The plant as a USD stage with physics (``simulation.usda``)."""
