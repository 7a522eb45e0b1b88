"""The families of devices and structures that an assortment draws from."""

from cadgraph.environment.families.instruments.instrument import INSTRUMENTS
from cadgraph.environment.families.instruments.measuring import MEASURING
from cadgraph.environment.families.known import KNOWN
from cadgraph.environment.families.machines.machine import MACHINES
from cadgraph.environment.families.machines.rotating import ROTATING
from cadgraph.environment.families.piping.fitting import FITTINGS
from cadgraph.environment.families.piping.pipework import PIPEWORK
from cadgraph.environment.families.steel.frame import FRAMES
from cadgraph.environment.families.steel.steelwork import STEELWORK
from cadgraph.environment.families.supports.connection import CONNECTIONS
from cadgraph.environment.families.supports.support import SUPPORTS
from cadgraph.environment.families.utilities.safety import SAFETY
from cadgraph.environment.families.utilities.utility import UTILITIES
from cadgraph.environment.families.valves.isolating import ISOLATING
from cadgraph.environment.families.valves.protecting import PROTECTING
from cadgraph.environment.families.valves.small import SMALL_VALVES
from cadgraph.environment.families.valves.valve import VALVE_FAMILIES
from cadgraph.environment.families.vessels.equipment import EQUIPMENT
from cadgraph.environment.families.vessels.plantware import PLANTWARE
from cadgraph.environment.families.vessels.vessel import VESSELS
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
