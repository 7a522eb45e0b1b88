"""How plants are modelled: published styles, styles drawn at random, the manners of authoring systems."""
