"""The families of devices and structures that an assortment draws from."""

from cadgraph.environment.families.known import KNOWN
from cadgraph.environment.family import Family

__all__ = ["FAMILIES"]

FAMILIES: dict[str, Family] = {family.name: family for family in (*KNOWN,)}
