"""The functional graph as a schematic in the manner of P&IDs."""
