"""Steps 32 worlds at once, each with a die that is thrown differently, and counts what they show."""

from collections import Counter

import numpy as np

import tautline as tl

FACES = np.array([[0, 1, 0], [0, -1, 0], [1, 0, 0], [-1, 0, 0], [0, 0, 1], [0, 0, -1]])
PIPS = [1, 6, 3, 4, 2, 5]


def thrown(random: np.random.Generator) -> tl.World:
    world = tl.World()
    world.add(tl.HalfSpace(friction=0.4, restitution=0.3))
    die = tl.RigidBody(
        tl.Shape.cuboid((0.1, 0.1, 0.1)),
        position=(0, 1, 0),
        rotation=random.normal(size=4),
        velocity=random.normal(size=3),
        angular_velocity=10 * random.normal(size=3),
    )
    world.add(die, name="die")
    return world


def shown(die: tl.Body) -> int:
    """The face that points up."""
    x, y, z, w = die.rotation
    up_in_die = np.array([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)])
    return PIPS[int(np.argmax(FACES @ up_in_die))]


random = np.random.default_rng(1)
batch = tl.Batch([thrown(random) for _ in range(32)])
for second in range(1, 5):
    batch.step(60)
    speed = np.linalg.norm(batch.velocities[:, 1], axis=1)
    print(f"after {second} s the fastest die moves at {speed.max():.3f} m/s")
print("pips:", dict(sorted(Counter(shown(world["die"]) for world in batch.worlds).items())))

heights = batch.centers[:, 1, 1]
assert np.allclose(heights, 0.1, atol=0.002), "they lie on their faces"
