"""Turns the valves of a stage in Newton on the processor; run by an interpreter that has newton[sim,importers].

Writes what happened to the standard output, as JSON on its last line.
"""

import json
import sys
import warnings
from pathlib import Path

import newton
import numpy as np
import warp

STEP = 1 / 480


def turn(folder):
    devices = {row["joint"]: row for row in json.loads((folder / "devices.json").read_text())["devices"]}
    warp.config.quiet = True
    builder = newton.ModelBuilder(up_axis=newton.Axis.Z)
    with warnings.catch_warnings():
        # It says of each wheel that its own valve, which is left out here, need not be told apart from it.
        warnings.simplefilter("ignore")
        builder.add_usd(
            str(folder / "simulation.usda"),
            ignore_paths=["/Plant/Scene.*", "/Plant/Colliders.*"],
            load_visual_shapes=False,
        )
    model = builder.finalize(device="cpu")
    names = [label.rsplit("/", 1)[-1] for label in builder.joint_label]
    names = [name for name in names if name in devices]
    rows = [devices[name] for name in names]
    solver = newton.solvers.SolverMuJoCo(model, use_mujoco_cpu=True, disable_contacts=True)
    states, control = [model.state(), model.state()], model.control()
    friction = np.array([row["friction_nm"] for row in rows])
    way = np.array([np.sign(sum(row["limits_deg"])) for row in rows])

    def under(share, seconds):
        control.joint_f = warp.array((share * friction * way).astype(np.float32), dtype=warp.float32, device="cpu")
        for _ in range(round(seconds / STEP)):
            solver.step(states[0], states[1], control, None, STEP)
            states.reverse()
        return dict(zip(names, np.rad2deg(states[0].joint_q.numpy()).tolist(), strict=True))

    return {"names": names, "rest": under(0.0, 1.0), "half": under(0.5, 1.0), "triple": under(3.0, 1.0)}


if __name__ == "__main__":
    sys.stdout.write(f"\n{json.dumps(turn(Path(sys.argv[1]).resolve()))}\n")
