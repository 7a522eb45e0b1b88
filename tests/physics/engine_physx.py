"""Turns the valves of a stage in PhysX on the processor; run by an interpreter that has ovphysx.

Writes what happened to the standard output, as JSON on its last line. The engine brings a USD library of its own, which
can't live in one process with another.
"""

import json
import sys
import warnings
from pathlib import Path

import numpy as np
import ovphysx
import ovstage
import physx_usd_schemas
from ovphysx import PhysX, TensorType

STEP = 1 / 240

# The tensors of this release say that the next one calls them otherwise.
warnings.simplefilter("ignore", DeprecationWarning)


class Engine:
    def __init__(self, stage):
        PhysX.set_cpu_mode(True)
        self.physx = PhysX()
        schemas = [*map(str, physx_usd_schemas.schema_paths()), str(ovphysx.newton_schema_root())]
        ovstage.population.register_usd_schemas(schemas)
        self.stage = ovstage.Stage("plant")
        ovstage.population.open_usd(self.stage, str(stage), ordinal=1, domains=ovstage.PopulationDomain.ALL)
        self.stage.advance_write_floor(ordinal=1).wait()
        self.physx.wait_task(self.physx.attach_ovstage(self.stage, read_ordinal=1))

    def bind(self, pattern, kind):
        return self.physx.create_tensor_binding(pattern=pattern, tensor_type=getattr(TensorType, kind))

    def run(self, seconds, each=None):
        for _ in range(round(seconds / STEP)):
            if each is not None:
                each()
            self.physx.step(STEP)
        self.physx.wait_all()


def read(binding):
    values = np.zeros(binding.shape, np.float32)
    binding.read(values)
    return values


def turn(folder):
    """Rest, half and three times of what starts each valve, and needles to the middle of their dials."""
    devices = {row["joint"]: row for row in json.loads((folder / "devices.json").read_text())["devices"]}
    engine = Engine(folder / "simulation.usda")
    angle = engine.bind("/Plant/Devices", "ARTICULATION_DOF_POSITION")
    torque = engine.bind("/Plant/Devices", "ARTICULATION_DOF_ACTUATION_FORCE")
    goal = engine.bind("/Plant/Devices", "ARTICULATION_DOF_POSITION_TARGET")
    link = engine.bind("/Plant/Devices", "ARTICULATION_LINK_POSE")
    names = list(angle.dof_names)
    rows = [devices[name] for name in names]
    friction = np.array([row["friction_nm"] for row in rows])
    way = np.array([np.sign(sum(row["limits_deg"])) for row in rows])

    def under(share, seconds):
        force = np.ascontiguousarray((share * friction * way)[None], np.float32)
        engine.run(seconds, lambda: torque.write(force))
        return dict(zip(names, np.rad2deg(read(angle)[0]).tolist(), strict=True))

    found = {"names": names, "rest": under(0.0, 2.0), "half": under(0.5, 1.0), "triple": under(3.0, 1.0)}
    found["poses"] = read(link)[0].tolist()
    middle = np.array([np.mean(row["limits_deg"]) if row["kind"] == "needle" else 0.0 for row in rows])
    goal.write(np.ascontiguousarray(np.deg2rad(middle)[None], np.float32))
    shown = under(0.0, 2.0)
    needles = [name for name in names if devices[name]["kind"] == "needle"]
    found["needles"] = {name: shown[name] - middle[names.index(name)] for name in needles}
    return found


def three(folder):
    """Three plants by reference: where their bases are after a while."""
    engine = Engine(folder / "three.usda")
    link = engine.bind("/World/env_*/Plant/Devices", "ARTICULATION_LINK_POSE")
    engine.run(0.5)
    return {"bases": read(link)[:, 0, :3].tolist()}


def thrown(folder):
    """Balls on what stands still, and one thrown against a lever."""
    engine = Engine(folder / "balls.usda")
    angle = engine.bind("/Plant/Devices", "ARTICULATION_DOF_POSITION")
    resting = engine.bind("/Rest_*", "RIGID_BODY_POSE")
    before = read(resting)
    engine.run(0.1)
    fallen = (before - read(resting))[:, 2]
    engine.run(0.4)
    angles = dict(zip(angle.dof_names, np.rad2deg(read(angle)[0]).tolist(), strict=True))
    return {"fallen": fallen.tolist(), "angles": angles}


if __name__ == "__main__":
    done = {"turn": turn, "three": three, "thrown": thrown}[sys.argv[1]](Path(sys.argv[2]).resolve())
    sys.stdout.write(f"\n{json.dumps(done)}\n")
