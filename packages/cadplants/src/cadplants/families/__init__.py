"""The families of devices and structures that an assortment draws from."""

from cadplants.families.instruments.instrument import INSTRUMENTS
from cadplants.families.instruments.measuring import MEASURING
from cadplants.families.machines.machine import MACHINES
from cadplants.families.machines.rotating import ROTATING
from cadplants.families.piping.fitting import FITTINGS
from cadplants.families.piping.pipework import PIPEWORK
from cadplants.families.preset_devices import PRESET_DEVICES
from cadplants.families.steel.frame import FRAMES
from cadplants.families.steel.steelwork import STEELWORK
from cadplants.families.supports.connection import CONNECTIONS
from cadplants.families.supports.support import SUPPORTS
from cadplants.families.utilities.safety import SAFETY
from cadplants.families.utilities.utility import UTILITIES
from cadplants.families.valves.isolating import ISOLATING
from cadplants.families.valves.protecting import PROTECTING
from cadplants.families.valves.threaded import THREADED
from cadplants.families.valves.valve import VALVE_FAMILIES
from cadplants.families.vessels.equipment import EQUIPMENT
from cadplants.families.vessels.kinds import KINDS_OF_VESSELS
from cadplants.families.vessels.vessel import VESSELS
from cadplants.model.family import Family

__all__ = ["FAMILIES"]

# By name; a plant can leave out a whole family, or all builds of a kind by what comes before the slash.
FAMILIES: dict[str, Family] = {
    family.name: family
    for family in (
        *PRESET_DEVICES,
        *VALVE_FAMILIES,
        *THREADED,
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
        *KINDS_OF_VESSELS,
        *SUPPORTS,
        *STEELWORK,
        *UTILITIES,
    )
}
