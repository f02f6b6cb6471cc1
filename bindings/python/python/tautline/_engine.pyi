"""The compiled half of the package. Everything here is known as ``tautline.NAME``."""

import os
from typing import (
    Any,
    Callable,
    Dict,
    Final,
    List,
    Literal,
    Mapping,
    Optional,
    Sequence,
    Tuple,
    Union,
    final,
)

import numpy as np
from numpy.typing import ArrayLike, NDArray

from matplotlib.figure import Figure

from ._types import NamedScene, Series

__all__ = [
    "Anchor",
    "Attachment",
    "Batch",
    "Body",
    "Cloth",
    "ContactEvent",
    "Distance",
    "Grab",
    "Grid",
    "HalfSpace",
    "Hit",
    "Joint",
    "Lattice",
    "Recording",
    "RigidBody",
    "Rope",
    "Scene",
    "Settings",
    "Shape",
    "SoftSolid",
    "StepReport",
    "World",
    "__version__",
    "distance",
    "read_mesh",
    "scenes",
    "set_threads",
    "validate_json",
]

__version__: Final[str]

_Path = Union[str, os.PathLike[str]]
_Vector = Union[Sequence[float], NDArray[Any]]
_Vector3 = List[float]
_Pair = Tuple[float, float]
_Floats = NDArray[np.float32]
_Indices = NDArray[np.uint32]
_Mesh = Tuple[ArrayLike, ArrayLike]
_Progress = Union[bool, Callable[[int, int], object], None]
_Motion = Literal["dynamic", "kinematic", "fixed"]

@final
class Settings:
    """How a world is simulated.

    Args:
        gravity: In m/s²; (0, -9.81, 0) if absent.
        substeps: In a step, 1 to 1000.
        separation_speed: At most so fast overlapping bodies are moved apart, in m/s; 3 if absent, None: at once.
        damping: Rate at which free motion dies out, in 1/s.
        wind: Velocity of the air, in m/s; it acts on cloth with ``drag``.
        air_density: In kg/m³.
        sleep: A body slower than so many m/s for so many s falls asleep; (0.03, 0.5) if absent, None: never.
    """

    def __new__(
        cls,
        *,
        gravity: Optional[_Vector] = None,
        substeps: int = 8,
        separation_speed: Optional[float] = ...,
        damping: float = 0.0,
        wind: Optional[_Vector] = None,
        air_density: float = 1.2,
        sleep: Optional[_Pair] = ...,
    ) -> Settings: ...
    @staticmethod
    def paper() -> Settings:
        """The published system's own: one substep, ten sweeps, a tolerance of 1 %."""
    @property
    def gravity(self) -> _Vector3: ...
    @property
    def substeps(self) -> int: ...
    @property
    def separation_speed(self) -> Optional[float]: ...
    @property
    def damping(self) -> float: ...
    @property
    def wind(self) -> _Vector3: ...
    @property
    def air_density(self) -> float: ...
    @property
    def sleep(self) -> Optional[_Pair]: ...
    @property
    def is_paper(self) -> bool:
        """Whether cloth and rope are moved by the paper's solver."""

@final
class Shape:
    """The shape of a rigid body, in its own frame; many bodies share one."""

    @staticmethod
    def sphere(radius: float) -> Shape: ...
    @staticmethod
    def cuboid(half_extents: _Vector) -> Shape:
        """From half its edges, in m."""
    @staticmethod
    def capsule(radius: float, half_height: float) -> Shape:
        """Along y; ``half_height`` is that of the part between the two hemispheres, in m."""
    @staticmethod
    def cylinder(radius: float, half_height: float) -> Shape: ...
    @staticmethod
    def convex_hull(points: ArrayLike) -> Shape:
        """Of points (n, 3), in m."""
    @staticmethod
    def from_mesh(
        positions: ArrayLike,
        triangles: ArrayLike,
        *,
        max_parts: Optional[int] = None,
        tolerance: Optional[float] = None,
    ) -> Shape:
        """A closed mesh of positions (n, 3) in m and triangles (m, 3); a concave one becomes a union of at most ``max_parts``
        convex parts that are off by about ``tolerance`` (m)."""
    @staticmethod
    def triangle_mesh(positions: ArrayLike, triangles: ArrayLike) -> Shape:
        """A surface without an inside, for what is fixed or kinematic."""
    @staticmethod
    def compound(parts: Sequence[Tuple[Shape, _Vector, _Vector]]) -> Shape:
        """Several shapes as one, each with its position (m) and its rotation (x, y, z, w)."""
    @property
    def volume(self) -> float:
        """In m³; 0 for a surface."""
    @property
    def is_solid(self) -> bool: ...
    @property
    def center_of_mass(self) -> _Vector3: ...
    @property
    def part_count(self) -> int:
        """How many convex parts it has."""
    @property
    def positions(self) -> _Floats:
        """Vertices of its surface, in m: (n, 3)."""
    @property
    def triangles(self) -> _Indices:
        """Triangles of its surface: (m, 3)."""

@final
class HalfSpace:
    """Everything behind a plane: a floor, unless told otherwise.

    Args:
        normal: Out of the solid; (0, 1, 0) if absent.
        offset: Of the plane from the origin along the normal, in m.
    """

    def __new__(
        cls,
        normal: Optional[_Vector] = None,
        offset: float = 0.0,
        *,
        friction: float = 0.5,
        restitution: float = 0.0,
    ) -> HalfSpace: ...

@final
class RigidBody:
    """A rigid body to be added to a world.

    Args:
        shape: What it is.
        position: Of the origin of the shape's frame, in m.
        rotation: From the shape's frame to the world: a quaternion x, y, z, w.
        velocity: Of the centre of mass, in m/s.
        angular_velocity: In rad/s, in the world's frame.
        mass: In kg.
        density: In kg/m³, instead of a mass; 1000 if both are absent.
        friction: Coulomb's coefficient.
        restitution: Speed apart over speed together of a collision, 0 to 1.
        rolling_friction: How far, in m, the normal force acts in front of the contact when it rolls.
        motion: What moves it: forces, its velocity alone, or nothing.
        gravity_scale: How many times the world's gravity acts on it.
        damping: Rates at which its motion and its rotation die out, in 1/s; (0, 0) if absent.
        groups: Two bit masks, memberships and filter; all if absent.
        can_sleep: Whether it is put to sleep when it rests.
        report_contacts: Whether its contacts are in ``World.contact_events``.
    """

    def __new__(
        cls,
        shape: Shape,
        *,
        position: Optional[_Vector] = None,
        rotation: Optional[_Vector] = None,
        velocity: Optional[_Vector] = None,
        angular_velocity: Optional[_Vector] = None,
        mass: Optional[float] = None,
        density: Optional[float] = None,
        friction: float = 0.5,
        restitution: float = 0.0,
        rolling_friction: float = 0.0,
        motion: _Motion = "dynamic",
        gravity_scale: float = 1.0,
        damping: _Pair = ...,
        groups: Optional[Tuple[int, int]] = None,
        can_sleep: bool = True,
        report_contacts: bool = False,
    ) -> RigidBody: ...

@final
class Grid:
    """A level rectangle about the origin, ``width`` along x and ``depth`` along z (m), of ``columns`` × ``rows`` particles;
    particle ``row * columns + column``. For ``Cloth``."""

    def __new__(cls, columns: int, rows: int, width: float, depth: float) -> Grid: ...
    @property
    def columns(self) -> int: ...
    @property
    def rows(self) -> int: ...
    @property
    def width(self) -> float: ...
    @property
    def depth(self) -> float: ...
    @property
    def corners(self) -> List[int]:
        """The particles at the corners: least x and z first, then along x."""

@final
class Cloth:
    """A sheet to be added to a world.

    Args:
        surface: A ``Grid``, or a mesh as (positions (n, 3) in m, triangles (m, 3)).
        position: Where the surface's origin is put, in m.
        rotation: About the surface's origin: a quaternion x, y, z, w.
        sag: How far the middle of a grid hangs below its corners where it is laid out, in m.
        velocity: Of all particles, in m/s.
        mass: In kg.
        density: In kg/m², instead of a mass.
        friction: Coulomb's coefficient.
        thickness: How far from solids it is kept, in m.
        self_collision: Whether it collides with itself.
        bending_stiffness: Flexural rigidity, in N m.
        compliance: Strain per tension, in m/N; it does not stretch if absent.
        shear_compliance: Shear angle per force along a width, in m/N.
        strain_limit: The most that it stretches, as a share.
        drag: Coefficient of the air's resistance, about 1.2 for a plate.
        lift: Coefficient of the air's lift.
        pressure: Of the gas in a closed surface, over the surroundings, in Pa.
        tear_at: The strain at which it tears.
        creep: Strain beyond which it gets longer for good, and how fast, in 1/s.
        pins: Particles that stay where they start.
        seams: Pairs of particles that are sewn together.
    """

    def __new__(
        cls,
        surface: Union[Grid, _Mesh],
        *,
        position: Optional[_Vector] = None,
        rotation: Optional[_Vector] = None,
        sag: Optional[float] = None,
        velocity: Optional[_Vector] = None,
        mass: float = 1.0,
        density: Optional[float] = None,
        friction: float = 0.5,
        thickness: Optional[float] = None,
        self_collision: bool = True,
        bending_stiffness: Optional[float] = None,
        compliance: Optional[float] = None,
        shear_compliance: Optional[float] = None,
        strain_limit: Optional[float] = None,
        drag: Optional[float] = None,
        lift: Optional[float] = None,
        pressure: Optional[float] = None,
        tear_at: Optional[float] = None,
        creep: Optional[_Pair] = None,
        pins: Sequence[int] = ...,
        seams: Sequence[Tuple[int, int]] = ...,
    ) -> Cloth: ...

@final
class Rope:
    """A rope, or a net, to be added to a world.

    Args:
        points: Its particles (n, 3), in m.
        segments: Of a net: between which points, (m, 2).
        length: At rest, in m, if it is not the length it is laid out at.
        velocity: Of all particles, in m/s.
        mass: In kg.
        radius: In m.
        friction: Coulomb's coefficient.
        self_collision: Whether it collides with itself.
        bending_stiffness: E I, in N m².
        compliance: Strain per tension, in 1/N; it does not stretch if absent.
        least_angle: The least angle at any inner particle, in rad, 0 to π.
        pins: Particles that stay where they start.
    """

    def __new__(
        cls,
        points: ArrayLike,
        *,
        segments: Optional[ArrayLike] = None,
        length: Optional[float] = None,
        velocity: Optional[_Vector] = None,
        mass: float = 1.0,
        radius: float = 0.02,
        friction: float = 0.5,
        self_collision: bool = False,
        bending_stiffness: Optional[float] = None,
        compliance: Optional[float] = None,
        least_angle: Optional[float] = None,
        pins: Sequence[int] = ...,
    ) -> Rope: ...

@final
class Lattice:
    """A box from ``-half_extents`` to ``half_extents`` (m) of so many cells along each axis. For ``SoftSolid``."""

    def __new__(cls, half_extents: _Vector, cells: Sequence[int]) -> Lattice: ...

@final
class SoftSolid:
    """A soft solid to be added to a world: a jelly, a tyre, a sponge.

    Args:
        volume: A ``Lattice``, or a closed mesh as (positions (n, 3) in m, triangles (m, 3)).
        position: Where the origin of its shape is put, in m.
        rotation: About that: a quaternion x, y, z, w.
        velocity: In m/s.
        angular_velocity: In rad/s.
        density: In kg/m³.
        mass: In kg, instead of a density.
        young_modulus: In Pa.
        poisson_ratio: 0 to 0.49.
        friction: Coulomb's coefficient.
        thickness: How far from solids its particles are kept, in m.
        self_collision: Whether it collides with itself.
        pins: Particles that stay where they start.
    """

    def __new__(
        cls,
        volume: Union[Lattice, _Mesh],
        *,
        position: Optional[_Vector] = None,
        rotation: Optional[_Vector] = None,
        velocity: Optional[_Vector] = None,
        angular_velocity: Optional[_Vector] = None,
        density: float = 1000.0,
        mass: Optional[float] = None,
        young_modulus: float = 1e5,
        poisson_ratio: float = 0.45,
        friction: float = 0.5,
        thickness: Optional[float] = None,
        self_collision: bool = True,
        pins: Sequence[int] = ...,
    ) -> SoftSolid: ...

_Builder = Union[RigidBody, Cloth, Rope, SoftSolid, HalfSpace]

@final
class World:
    """Everything that is simulated together.

    Args:
        settings: How.
        name: What its recordings are called.
        dt: The time of a step, in s.
    """

    def __new__(cls, settings: Optional[Settings] = None, *, name: str = ..., dt: float = ...) -> World: ...
    def add(
        self, body: _Builder, *, name: Optional[str] = None, color: Optional[Tuple[int, int, int]] = None
    ) -> Body:
        """Adds a body; its name is made up if absent, its colour (sRGB, 0 to 255) chosen."""
    def remove(self, body: Body) -> None:
        """Removes a body with its joints and attachments."""
    @property
    def bodies(self) -> List[Body]:
        """All bodies, in the order they were added."""
    def __getitem__(self, name: str, /) -> Body: ...
    def __len__(self) -> int: ...
    @property
    def settings(self) -> Settings: ...
    @settings.setter
    def settings(self, settings: Settings) -> None: ...
    def set_wind(self, wind: _Vector) -> None:
        """Velocity of the air, in m/s, from the next step on."""
    @property
    def name(self) -> str: ...
    @property
    def time(self) -> float:
        """The simulated time, in s."""
    @property
    def dt(self) -> float:
        """The time of a step, in s, unless told otherwise."""
    @property
    def positions(self) -> _Floats:
        """Positions of all particles, in m: a read-only view (n, 3) of the engine's memory, which changes with every step.

        When a body is added or removed, or the world restored, views from before stay as they were: ask again."""
    @property
    def state_hash(self) -> str:
        """A hash of everything that moves, 16 hexadecimal digits: equal states have equal hashes, on every platform."""
    @property
    def kinetic_energy(self) -> float:
        """In J."""
    @property
    def potential_energy(self) -> float:
        """In J, 0 at the origin."""
    @property
    def momentum(self) -> _Vector3:
        """In kg m/s."""
    @property
    def angular_momentum(self) -> _Vector3:
        """About the origin, in kg m²/s."""
    @property
    def strain(self) -> Tuple[float, float]:
        """How far sticks are off their lengths, as shares: (largest, mean)."""
    @property
    def penetration(self) -> Tuple[float, float, int]:
        """How deep bodies are in each other, in m: (deepest, mean over the pairs that penetrate, how many those are)."""
    def snapshot(self) -> bytes:
        """The whole world as bytes: it goes on from them with the same bits, on any platform."""
    def restore(self, snapshot: bytes) -> None:
        """Becomes the world that a snapshot was taken of. Bodies that both have keep their names and looks."""
    @classmethod
    def from_snapshot(cls, snapshot: bytes, *, dt: float = ...) -> World: ...
    def copy(self) -> World:
        """Another world in the same state."""
    def step(self, dt: Optional[float] = None) -> StepReport:
        """Advances by ``dt`` seconds, or by its own. Other threads of Python go on meanwhile. A scene's cues are followed where
        steps are as long as its own."""
    def run(
        self,
        seconds: Optional[float] = None,
        *,
        dt: Optional[float] = None,
        record: bool = True,
        every: Optional[int] = None,
        progress: _Progress = None,
    ) -> Recording:
        """Takes steps for so many seconds, or as long as the scene says. Ctrl-C stops it; the world is then where it came to.

        Args:
            seconds: How long, in s.
            dt: The time of a step, in s, if it is not the world's.
            record: Whether what there is to see is kept, or figures only.
            every: Keep one step in so many.
            progress: True for a bar of tqdm, or a function of (steps done, steps).
        """
    def look_now(self) -> Recording:
        """What it looks like now: a recording of one frame."""
    @property
    def contact_events(self) -> List[ContactEvent]:
        """Which bodies touched in the last step, out of the pairs of which one reports its contacts."""
    @property
    def broken_joints(self) -> List[Joint]:
        """The joints that broke in the last step."""
    @property
    def joints(self) -> List[Joint]: ...
    def add_ball_joint(
        self,
        body: Body,
        base: Optional[Body] = None,
        *,
        anchor: Optional[_Vector] = None,
        axis: Optional[_Vector] = None,
        cone: Optional[float] = None,
        twist: Optional[_Pair] = None,
        compliance: float = 0.0,
        break_force: Optional[float] = None,
        collide_connected: bool = False,
    ) -> Joint:
        """Keeps a point of a body together with one of another, or of the world.

        Args:
            body: What is held.
            base: What it is held to; the world if absent.
            anchor: Where, in the world, in m; the body's centre of mass if absent.
            axis: Of swing and twist, in the world.
            cone: The most that the axis swings, in rad.
            twist: Least and greatest turn about the axis, in rad.
            compliance: In m/N.
            break_force: In N.
            collide_connected: Whether the two collide.
        """
    def add_hinge_joint(
        self,
        body: Body,
        base: Optional[Body] = None,
        *,
        axis: _Vector,
        anchor: Optional[_Vector] = None,
        limits: Optional[_Pair] = None,
        motor: Optional[_Pair] = None,
        compliance: float = 0.0,
        angular_compliance: float = 0.0,
        break_force: Optional[float] = None,
        break_torque: Optional[float] = None,
        collide_connected: bool = False,
    ) -> Joint:
        """Keeps two points and an axis together; limits in rad, the motor's speed (rad/s) and greatest torque (N m)."""
    def add_fixed_joint(
        self,
        body: Body,
        base: Optional[Body] = None,
        *,
        anchor: Optional[_Vector] = None,
        compliance: float = 0.0,
        angular_compliance: float = 0.0,
        break_force: Optional[float] = None,
        break_torque: Optional[float] = None,
        collide_connected: bool = False,
    ) -> Joint:
        """Lets nothing move."""
    def add_slider_joint(
        self,
        body: Body,
        base: Optional[Body] = None,
        *,
        axis: _Vector,
        anchor: Optional[_Vector] = None,
        limits: Optional[_Pair] = None,
        motor: Optional[_Pair] = None,
        compliance: float = 0.0,
        angular_compliance: float = 0.0,
        break_force: Optional[float] = None,
        break_torque: Optional[float] = None,
        collide_connected: bool = False,
    ) -> Joint:
        """Leaves a shift along an axis free; limits in m, the motor's speed (m/s) and greatest force (N)."""
    def add_distance_joint(
        self,
        body: Body,
        base: Optional[Body] = None,
        *,
        anchors: Optional[Tuple[_Vector, _Vector]] = None,
        length: Optional[float] = None,
        range: Optional[_Pair] = None,
        spring: Optional[_Pair] = None,
        compliance: float = 0.0,
        break_force: Optional[float] = None,
        collide_connected: bool = False,
    ) -> Joint:
        """Keeps two points (in the world, m) at a length, or in a range of lengths (m), or near one by a spring of a frequency
        (Hz) and a damping ratio."""
    def attach(
        self, a: Anchor, b: Anchor, *, compliance: float = 0.0, break_force: Optional[float] = None
    ) -> Attachment:
        """Keeps two points together, of which one at least is on cloth or rope."""
    def grab(
        self, body: Body, point: _Vector, *, frequency: float = 8.0, max_acceleration: float = 500.0
    ) -> Grab:
        """Picks a body up at a point (m), to lead it about by a soft stick."""
    def ray_cast(
        self,
        origin: _Vector,
        direction: _Vector,
        max: float = 1e6,
        *,
        exclude: Optional[Body] = None,
        fixed: bool = True,
        movable: bool = True,
        groups: Optional[Tuple[int, int]] = None,
    ) -> Optional[Hit]:
        """The first body that a ray enters, up to the distance ``max`` (m)."""
    def ray_cast_all(
        self,
        origin: _Vector,
        direction: _Vector,
        max: float = 1e6,
        *,
        exclude: Optional[Body] = None,
        fixed: bool = True,
        movable: bool = True,
        groups: Optional[Tuple[int, int]] = None,
    ) -> List[Hit]:
        """All bodies that a ray enters, nearest first."""
    def shape_cast(
        self,
        shape: Shape,
        position: _Vector,
        translation: _Vector,
        *,
        rotation: Optional[_Vector] = None,
        exclude: Optional[Body] = None,
        fixed: bool = True,
        movable: bool = True,
        groups: Optional[Tuple[int, int]] = None,
    ) -> Optional[Hit]:
        """The first body that a shape touches which moves by ``translation`` (m) without turning; the hit's ``distance`` is how
        much of its way it has gone, 0 to 1."""
    def overlap(
        self,
        shape: Shape,
        position: _Vector,
        *,
        rotation: Optional[_Vector] = None,
        exclude: Optional[Body] = None,
        fixed: bool = True,
        movable: bool = True,
        groups: Optional[Tuple[int, int]] = None,
    ) -> List[Body]:
        """The bodies that a shape overlaps or touches."""
    def closest_point(
        self,
        point: _Vector,
        max: float = 1e6,
        *,
        exclude: Optional[Body] = None,
        fixed: bool = True,
        movable: bool = True,
        groups: Optional[Tuple[int, int]] = None,
    ) -> Optional[Hit]:
        """The body whose surface is closest to a point (m); the hit's ``distance`` is below 0 in a body."""
    @property
    def _positions_address(self) -> int: ...
    def _repr_html_(self) -> str: ...
    def __copy__(self) -> World: ...
    def __deepcopy__(self, _memo: object, /) -> World: ...

@final
class Body:
    """A body of a world. It goes on naming that body whatever else comes and goes; once removed, ``StaleHandleError``."""

    @property
    def world(self) -> World: ...
    @property
    def name(self) -> str: ...
    @property
    def kind(self) -> Literal["rigid", "truss", "cloth", "rope", "soft_solid", "half_space"]: ...
    @property
    def is_there(self) -> bool:
        """Whether it is in its world still."""
    @property
    def position(self) -> _Vector3:
        """Where the origin of a rigid body's shape is, in m."""
    @position.setter
    def position(self, position: _Vector) -> None: ...
    @property
    def rotation(self) -> List[float]:
        """From a rigid body's frame to the world: a quaternion x, y, z, w."""
    @rotation.setter
    def rotation(self, rotation: _Vector) -> None: ...
    def set_pose(self, position: _Vector, rotation: _Vector) -> None: ...
    @property
    def velocity(self) -> _Vector3:
        """Of the centre of mass, in m/s."""
    @velocity.setter
    def velocity(self, velocity: _Vector) -> None: ...
    @property
    def angular_velocity(self) -> _Vector3:
        """Of a rigid body, in rad/s, in the world's frame."""
    @angular_velocity.setter
    def angular_velocity(self, angular_velocity: _Vector) -> None: ...
    @property
    def center_of_mass(self) -> _Vector3: ...
    @property
    def mass(self) -> float:
        """In kg."""
    @property
    def inertia(self) -> List[_Vector3]:
        """Of a rigid body about its centre of mass, in the world's frame, in kg m²: three columns."""
    @property
    def gas(self) -> Optional[_Pair]:
        """The volume (m³) and the pressure (Pa over the surroundings) of a cloth with gas in it."""
    @property
    def positions(self) -> _Floats:
        """Positions of its particles, in m: a read-only view (n, 3), see ``World.positions``. Of a rigid body these are the four
        that it is made of: see ``surface_positions``."""
    def set_positions(self, positions: _Floats) -> None:
        """Puts the particles of a cloth, rope or soft solid somewhere (m), without a velocity: float32, C-contiguous, (n, 3)."""
    @property
    def inverse_masses(self) -> _Floats:
        """Of its particles, in 1/kg, 0 = pinned: a read-only view (n,), see ``World.positions``."""
    @property
    def particle_velocities(self) -> _Floats:
        """Of its particles, in m/s: (n, 3)."""
    def set_particle_velocities(self, velocities: _Floats) -> None:
        """Sets the velocities of the particles of a cloth, rope or soft solid, in m/s: float32, C-contiguous, (n, 3). Nothing
        happens to pinned ones."""
    @property
    def surface_positions(self) -> _Floats:
        """The vertices of its surface, in m: (v, 3)."""
    @property
    def triangles(self) -> _Indices:
        """The triangles of its surface: (t, 3)."""
    def pin(self, particle: int) -> None:
        """Pins a particle of a cloth, rope or soft solid where it is."""
    def unpin(self, particle: int) -> None: ...
    def apply_force(
        self, force: _Vector, *, point: Optional[_Vector] = None, particle: Optional[int] = None
    ) -> None:
        """During the next step, in N: at the centre of mass, at a point of a rigid body (m), or on one particle."""
    def apply_torque(self, torque: _Vector) -> None:
        """On a rigid body during the next step, in N m, in the world's frame."""
    def apply_impulse(self, impulse: _Vector, *, point: Optional[_Vector] = None) -> None:
        """At once, in N s: at the centre of mass, or at a point of a rigid body (m)."""
    @property
    def motion(self) -> _Motion: ...
    @motion.setter
    def motion(self, motion: _Motion) -> None: ...
    @property
    def friction(self) -> float:
        """Coulomb's coefficient."""
    @property
    def is_asleep(self) -> bool: ...
    def wake(self) -> None: ...
    @property
    def rope_length(self) -> float:
        """Of all segments of a rope together, at rest, in m; set, it is wound in or out."""
    @rope_length.setter
    def rope_length(self, length: float) -> None: ...

@final
class Joint:
    """A joint of a world."""

    @property
    def kind(self) -> Literal["ball", "hinge", "fixed", "slider", "distance"]: ...
    @property
    def angle(self) -> Optional[float]:
        """Of a hinge, in rad."""
    @property
    def translation(self) -> Optional[float]:
        """Of a slider, in m."""
    @property
    def force(self) -> _Vector3:
        """On the body, mean of the last step, in N."""
    @property
    def torque(self) -> _Vector3:
        """On the body, mean of the last step, in N m."""
    @property
    def is_broken(self) -> bool: ...
    def set_motor(self, motor: Optional[_Pair]) -> None:
        """Speed (rad/s or m/s) and greatest torque (N m) or force (N); None: no motor."""
    def set_limits(self, limits: Optional[_Pair]) -> None:
        """Least and greatest angle (rad) or shift (m); None: no limits."""
    def remove(self) -> None: ...

@final
class Anchor:
    """A point of a body, or of the world, where an attachment holds it."""

    @staticmethod
    def particle(body: Body, particle: int) -> Anchor: ...
    @staticmethod
    def triangle(body: Body, triangle: int, weights: Sequence[float]) -> Anchor:
        """A point of a triangle of a cloth, by its barycentric weights."""
    @staticmethod
    def segment(body: Body, segment: int, fraction: float) -> Anchor:
        """A point of a segment of a rope: 0 where the segment begins, 1 where it ends."""
    @staticmethod
    def point(body: Body, point: _Vector) -> Anchor:
        """A point of a rigid body, in its own frame, in m."""
    @staticmethod
    def world(point: _Vector) -> Anchor:
        """A point of the world, in m."""

@final
class Attachment:
    """An attachment of a world."""

    @property
    def force(self) -> _Vector3:
        """On the first end, mean of the last step, in N."""
    @property
    def is_broken(self) -> bool: ...
    def detach(self) -> None: ...

@final
class Grab:
    """A body that is held at a point."""

    def move_to(self, target: _Vector) -> None:
        """Where what is held is drawn to, in m."""
    def release(self) -> None: ...

@final
class Hit:
    """Where a query met a body."""

    @property
    def body(self) -> Body: ...
    @property
    def point(self) -> _Vector3:
        """On the body's surface, in m."""
    @property
    def normal(self) -> _Vector3:
        """Unit, out of the body."""
    @property
    def distance(self) -> float:
        """In m; of a moving shape, how much of its way it has gone."""

@final
class Distance:
    """The signed distance of two convex hulls, and where it is."""

    @property
    def distance(self) -> float:
        """In m: above 0 the gap, below 0 the depth."""
    @property
    def normal(self) -> _Vector3:
        """Unit, from A to B."""
    @property
    def point_a(self) -> _Vector3:
        """The witness point on A, in m."""
    @property
    def point_b(self) -> _Vector3:
        """The witness point on B, in m."""
    @property
    def iterations(self) -> int: ...
    @property
    def converged(self) -> bool:
        """Whether the answer is certain within rounding."""

@final
class StepReport:
    """What a step did."""

    @property
    def pairs(self) -> int:
        """Pairs of bodies whose boxes overlapped."""
    @property
    def contacts(self) -> int: ...
    @property
    def visits(self) -> int:
        """Sticks looked at."""
    @property
    def relaxations(self) -> int:
        """Sticks relaxed."""
    @property
    def awake_bodies(self) -> int: ...
    @property
    def faults(self) -> List[Body]:
        """Bodies that turned non-finite and have been frozen."""
    @property
    def seconds(self) -> float:
        """What the engine took, in s."""

@final
class ContactEvent:
    """How two bodies touched in the last step."""

    @property
    def kind(self) -> Literal["began", "persists", "ended"]: ...
    @property
    def bodies(self) -> Tuple[Body, Body]:
        """The one that was added first comes first."""
    @property
    def normal(self) -> _Vector3:
        """Unit, from the first to the second."""
    @property
    def point(self) -> _Vector3:
        """In m."""
    @property
    def impulse(self) -> float:
        """Of the whole step, in N s."""
    @property
    def approach_speed(self) -> float:
        """In m/s, if they began to touch."""

@final
class Batch:
    """Many worlds that are stepped at once, on all cores. What they are stacked from must be of equal size."""

    def __new__(cls, worlds: Sequence[World]) -> Batch: ...
    @property
    def worlds(self) -> List[World]: ...
    def __len__(self) -> int: ...
    def step(self, count: int = 1, *, dt: Optional[float] = None) -> None:
        """Advances all worlds by ``count`` steps."""
    @property
    def positions(self) -> _Floats:
        """Of all particles, in m: (worlds, particles, 3)."""
    @property
    def centers(self) -> _Floats:
        """Centres of mass of all bodies, in m: (worlds, bodies, 3)."""
    @property
    def velocities(self) -> _Floats:
        """Of all bodies, in m/s: (worlds, bodies, 3)."""
    @property
    def energies(self) -> NDArray[np.float64]:
        """Kinetic and potential energy, in J: (worlds, 2)."""
    @property
    def state_hashes(self) -> List[str]: ...

@final
class Scene:
    """A scene document, whose values have been judged.

    Args:
        document: A dict as the document's JSON has it; NumPy's numbers and arrays will do.
    """

    def __new__(cls, document: Mapping[str, Any]) -> Scene: ...
    @staticmethod
    def from_json(text: str) -> Scene: ...
    @staticmethod
    def load(path: _Path) -> Scene:
        """From a file: .json, .json5 or .toml, with the mesh files it names."""
    @staticmethod
    def named(name: str, /, **parameters: float) -> Scene:
        """A named scene, see ``scenes``, with its parameters."""
    @property
    def name(self) -> str: ...
    @property
    def seconds(self) -> float:
        """How long it runs, in s."""
    def to_json(self) -> str: ...
    def to_dict(self) -> Dict[str, Any]:
        """The document as a dict, to be edited and given to ``Scene``."""
    def build(self) -> World:
        """Makes the world that it describes."""
    def run(
        self,
        seconds: Optional[float] = None,
        *,
        dt: Optional[float] = None,
        record: bool = True,
        every: Optional[int] = None,
        progress: _Progress = None,
    ) -> Recording:
        """Makes its world and runs that: see ``World.run``."""

@final
class Recording:
    """What a run looked like, and its figures over time."""

    @property
    def name(self) -> str: ...
    @property
    def state_hash(self) -> str:
        """Of the world at the end of the run."""
    @property
    def steps(self) -> int:
        """How many the run took."""
    @property
    def engine_seconds(self) -> float:
        """What the engine took for all steps, in s."""
    @property
    def faults(self) -> int:
        """How many bodies turned non-finite and were frozen."""
    @property
    def frame_rate(self) -> float:
        """Frames in a second."""
    @property
    def frame_count(self) -> int: ...
    @property
    def tracks(self) -> List[str]:
        """The names of what there is to see."""
    def positions(self, track: str) -> _Floats:
        """World positions of a track's vertices, in m: (frames, v, 3); one frame of what never moves."""
    def poses(self, track: str) -> Optional[_Floats]:
        """Position (m) and quaternion x, y, z, w of a rigid track: (frames, 7); None of other tracks."""
    def vertices(self, track: str) -> _Floats:
        """The vertices of a track's mesh, in m: of a rigid one in its own frame, of others at the first frame."""
    def triangles(self, track: str) -> _Indices:
        """The triangles of a track's mesh: (t, 3)."""
    def color(self, track: str) -> Tuple[int, int, int]:
        """sRGB, 0 to 255."""
    def is_sheet(self, track: str) -> bool:
        """Whether a track is seen from both sides."""
    @property
    def series(self) -> Series:
        """Figures at the start, at every frame and at the end, by name."""
    def save(
        self,
        path: _Path,
        *,
        size: Optional[Tuple[int, int]] = None,
        frame: Optional[int] = None,
        frame_rate: float = 30.0,
    ) -> None:
        """Writes it in the format that the extension names.

        Args:
            path: ``.gif``, ``.mp4``, ``.png``: pictures; ``.glb``, ``.usd``, ``.usda``, ``.usdc``: scenes with motion;
                ``.html``: a page that plays it, in itself;
                ``.pc2``: a point cache, with its mesh as ``.obj`` beside it; ``.obj``, ``.ply``: a mesh for each frame;
                ``.npz``: arrays.
            size: Width and height of pictures, in pixels; (640, 480) if absent.
            frame: Of a ``.png``; the last if absent.
            frame_rate: The most pictures a second in a ``.gif``, 1 to 50.
        """
    def plot(self) -> Figure:
        """Energy, contacts and strain over time, as a figure of Matplotlib."""
    def _write(
        self,
        path: _Path,
        *,
        size: Optional[Tuple[int, int]] = None,
        frame: Optional[int] = None,
        frame_rate: float = 30.0,
        ffmpeg: Optional[str] = None,
    ) -> None: ...
    def _repr_html_(self) -> str: ...

def distance(a: ArrayLike, b: ArrayLike) -> Distance:
    """The signed distance of the convex hulls of two sets of points, in m: (n, 3) and (m, 3)."""

def scenes() -> List[NamedScene]:
    """The named scenes."""

def read_mesh(path: _Path) -> Tuple[_Floats, _Indices]:
    """The positions (n, 3) in m and triangles (m, 3) of a mesh file: ``.obj``, ``.stl``, ``.ply``, ``.gltf`` or ``.glb``."""

def set_threads(count: int) -> None:
    """How many threads steps of this process are spread over, from the next on. Results do not depend on it."""

def validate_json(numbers: Optional[Sequence[int]] = None) -> str: ...
