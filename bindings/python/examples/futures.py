"""Looks into several futures of one moment: a snapshot, branched."""

import tautline as tl

world = tl.Scene.named("chain").build()
world.run(1, record=False)
moment = world.snapshot()

print("push in m/s   kinetic energy in J after another second   state")
hashes = []
for push in (0.0, 0.5, 1.0, 0.0):
    branch = tl.World.from_snapshot(moment)
    for body in branch.bodies:
        if body.motion == "dynamic":
            body.apply_impulse((push * body.mass, 0, 0))
    branch.run(1, record=False)
    hashes.append(branch.state_hash)
    print(f"{push:11.1f} {branch.kinetic_energy:41.3f}   {branch.state_hash}")

assert hashes[0] == hashes[3], "the same future twice, to the bit"
assert len(set(hashes)) == 3
