"""Questions about generated plants whose answers can be proved, for agents and for the graph that they ask."""
