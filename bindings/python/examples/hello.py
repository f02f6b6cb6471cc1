"""A ball is thrown at three boxes that stand on each other."""

import tautline as tl

world = tl.World()
world.add(tl.HalfSpace())
cube = tl.Shape.cuboid((0.5, 0.5, 0.5))  # Half its edges, in m.
boxes = [world.add(tl.RigidBody(cube, position=(0, 0.5 + k, 0), mass=2)) for k in range(3)]
ball = world.add(tl.RigidBody(tl.Shape.sphere(0.3), position=(-4, 2.5, 0), velocity=(8, 0, 0), mass=2))

print("   s │ lowest box │ middle box │ top box    │ ball, x and y in m")
for step in range(181):
    if step % 30 == 0:
        places = [body.center_of_mass for body in (*boxes, ball)]
        print(f"{world.time:4.1f} │", " │ ".join(f"{x:5.2f} {y:4.2f}" for x, y, _ in places))
    world.step()

assert abs(boxes[0].position[1] - 0.5) < 0.01, "the lowest box stays on the floor"
