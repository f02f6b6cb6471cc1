"""Measures sliding friction against theory: a box that slides comes to rest after v²/(2 μ g)."""

import tautline as tl

G = 9.81


def stopping_distance(friction: float, speed: float) -> float:
    """In m, of a box at this speed (m/s)."""
    world = tl.World(tl.Settings(sleep=None))
    world.add(tl.HalfSpace(friction=friction))
    shape = tl.Shape.cuboid((0.5, 0.1, 0.5))  # Low, so that it does not tumble.
    box = world.add(tl.RigidBody(shape, position=(0, 0.1, 0), velocity=(speed, 0, 0), friction=friction))
    world.run(1.5 * speed / (friction * G), record=False)
    return box.position[0]


print("   μ   v in m/s   theory in m   measured in m   error")
for friction in (0.2, 0.5, 0.8):
    for speed in (2.0, 5.0):
        theory, measured = speed**2 / (2 * friction * G), stopping_distance(friction, speed)
        error = measured / theory - 1
        print(f"{friction:4.1f} {speed:10.1f} {theory:13.4f} {measured:15.4f} {100 * error:6.2f} %")
        assert abs(error) < 0.005
