"""The families of devices and structures that an assortment draws from."""

from cadgraph.environment.families.connection import CONNECTIONS
from cadgraph.environment.families.equipment import EQUIPMENT
from cadgraph.environment.families.fitting import FITTINGS
from cadgraph.environment.families.frame import FRAMES
from cadgraph.environment.families.instrument import INSTRUMENTS
from cadgraph.environment.families.isolating import ISOLATING
from cadgraph.environment.families.known import KNOWN
from cadgraph.environment.families.machine import MACHINES
from cadgraph.environment.families.measuring import MEASURING
from cadgraph.environment.families.pipework import PIPEWORK
from cadgraph.environment.families.plantware import PLANTWARE
from cadgraph.environment.families.protecting import PROTECTING
from cadgraph.environment.families.rotating import ROTATING
from cadgraph.environment.families.safety import SAFETY
from cadgraph.environment.families.small import SMALL_VALVES
from cadgraph.environment.families.steelwork import STEELWORK
from cadgraph.environment.families.support import SUPPORTS
from cadgraph.environment.families.utility import UTILITIES
from cadgraph.environment.families.valve import VALVE_FAMILIES
from cadgraph.environment.families.vessels import VESSELS
from cadgraph.environment.family import Family

__all__ = ["FAMILIES"]

# By name; a plant can leave out a whole family, or all builds of a kind by what comes before the slash.
FAMILIES: dict[str, Family] = {
    family.name: family
    for family in (
        *KNOWN,
        *VALVE_FAMILIES,
        *SMALL_VALVES,
        *FITTINGS,
        *INSTRUMENTS,
        *ROTATING,
        *VESSELS,
        *EQUIPMENT,
        *CONNECTIONS,
        *FRAMES,
        *SAFETY,
        *ISOLATING,
        *PROTECTING,
        *MEASURING,
        *PIPEWORK,
        *MACHINES,
        *PLANTWARE,
        *SUPPORTS,
        *STEELWORK,
        *UTILITIES,
    )
}
