//! What a cloth is made of: how it bends and stretches, the air around it, the gas in it, its seams.

use super::Cloth;
use glam::Vec3;

use crate::body::fabric::{AirGrip, Creep, Fabric, Gas, Stretch, Wear, volume_of};
use crate::constraint::{AngleLimit, Bending, Stick, bending_gradient};
use crate::error::{Error, within};
use crate::mesh::{HalfEdgeMesh, TriMesh};
use crate::norm::Norm;

/// What a cloth was asked to be, beyond sticks of one length.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Wish {
    drag: Option<f32>,
    lift: Option<f32>,
    pressure: Option<f32>,
    pub(super) bending_stiffness: Option<f32>,
    compliance: Option<f32>,
    shear_compliance: Option<f32>,
    strain_limit: Option<f32>,
    seams: Vec<[u32; 2]>,
    wear: Wear,
}

/// What it is made of. Only [`ClothSolver::SmallSteps`](crate::ClothSolver::SmallSteps) knows this: under the paper's
/// solver a cloth that asks for any of it is refused.
impl Cloth {
    /// How the air drags at it: the coefficient C of the force F = ½ ρ C A |n·u| u on every triangle of area A and unit
    /// normal n, where u is the velocity of the [wind](crate::Settings::wind) past it and ρ the
    /// [density of the air](crate::Settings::air_density). About 1.2 for a plate that is blown upon from the front; absent
    /// or 0, there is no air. Drag never turns the relative motion round, however light the cloth is.
    ///
    /// ```
    /// use tautline::{Cloth, Settings, Vec3, World};
    ///
    /// let mut world = World::new(Settings { gravity: Vec3::ZERO, ..Settings::default() })?;
    /// let sail = world.add(Cloth::grid(8, 8, 1.0, 1.0).drag(1.2))?;
    /// world.set_wind(Vec3::Y * 5.0)?;
    /// for _ in 0..60 {
    ///     world.step(1.0 / 60.0)?;
    /// }
    /// let speed = world.body(sail)?.velocity().y;
    /// assert!(speed > 3.5 && speed < 5.0, "the wind takes it along");
    /// # Ok::<(), tautline::Error>(())
    /// ```
    pub fn drag(mut self, coefficient: f32) -> Self {
        self.wish.drag = Some(coefficient);
        self
    }

    /// How the air lifts it across the wind: the coefficient C of the force F = ½ ρ C A (n·u) |u| (n − û (n·û)) on every
    /// triangle, which is largest where the wind meets it at 45°, with what [`Cloth::drag`] says. It does no work on what
    /// moves against the air; flags flutter by it.
    pub fn lift(mut self, coefficient: f32) -> Self {
        self.wish.lift = Some(coefficient);
        self
    }

    /// Fills a closed surface with gas of this pressure p over the surroundings, in Pa, at the volume V it is built with.
    /// p V stays as it is: at half the volume the pressure is twice as large, up to a hundred times at a hundredth of it.
    /// A balloon of no symmetry that floats freely may slowly begin to turn.
    /// (Were p counted from vacuum, one per mille that a cloth is stretched would let out 300 Pa.)
    ///
    /// ```
    /// use tautline::mesh::primitives;
    /// use tautline::{Cloth, Settings, Vec3, World};
    ///
    /// let mut world = World::new(Settings::default())?;
    /// let balloon = Cloth::from_mesh(primitives::icosphere(0.2, 2)?).mass(0.05).pressure(500.0);
    /// let balloon = world.add(balloon)?;
    /// assert!((world.body(balloon)?.pressure().unwrap() - 500.0).abs() < 1.0);
    /// # Ok::<(), tautline::Error>(())
    /// ```
    pub fn pressure(mut self, pressure: f32) -> Self {
        self.wish.pressure = Some(pressure);
        self
    }

    /// Resists bending with this flexural rigidity B, in N·m: a strip of width b has the moment B b κ at the curvature κ.
    /// A cotton sheet has some 1e-5, paper 1e-3. It is exact as long as a small step can carry it; what is stiffer is as
    /// stiff as can be. On a grid, particles that follow each other want to be in line; on other meshes, angles between
    /// triangles are held as they are built, each with the compliance that gives the same B to a plate; narrow strips of
    /// such a mesh are softer by up to a sixth.
    pub fn bending_stiffness(mut self, rigidity: f32) -> Self {
        self.wish.bending_stiffness = Some(rigidity);
        self
    }

    /// How far it gives when it is pulled, in m/N: the strain per tension, where tension is force per width (N/m). So
    /// 1/compliance is Young's modulus times thickness, about 1e3 N/m for a knitted sheet and 1e5 for canvas. Every edge
    /// gets its share of the area beside it. Absent, it does not stretch but for what small steps leave.
    pub fn compliance(mut self, compliance: f32) -> Self {
        self.wish.compliance = Some(compliance);
        self
    }

    /// How far a grid with a [`Cloth::compliance`] gives when its cells are sheared, in m/N: the shear angle per force
    /// along a width. Absent, its diagonals are as any edge of a mesh. No effect on other surfaces.
    pub fn shear_compliance(mut self, compliance: f32) -> Self {
        self.wish.shear_compliance = Some(compliance);
        self
    }

    /// Lets it stretch up to this share of its length at rest and no further: 0.05 is 5 %. Up to there it is held by its
    /// [`Cloth::compliance`], or by nothing if it has none.
    pub fn strain_limit(mut self, share: f32) -> Self {
        self.wish.strain_limit = Some(share);
        self
    }

    /// Tears it where an edge is strained beyond this share of its length: 0.2 is 20 %. It needs a
    /// [`Cloth::compliance`], over which the strain is its strength in N/m.
    ///
    /// After each step, of the edges around a particle the one that is strained most tears, so that a tear runs along by
    /// an edge or two in a step. What tears goes with the triangles beside it: they are in
    /// [`BodyView::triangles`](crate::BodyView::triangles) no more, and those after them move up. A tear is so one edge
    /// wide. No particle comes or goes, and none gets another number: what grabs, pins and attachments hold they go on
    /// holding, also a particle that nothing else holds. Gas escapes through the first tear. The last triangles of a cloth
    /// do not tear.
    ///
    /// ```
    /// use tautline::{Cloth, Settings, World};
    ///
    /// let mut world = World::new(Settings::default())?;
    /// let paper = Cloth::grid(6, 6, 0.2, 0.2).mass(0.5).compliance(1e-3).tear_at(0.01);
    /// let paper = world.add(paper.pin(0).pin(5))?;
    /// for _ in 0..60 {
    ///     world.step(1.0 / 60.0)?;
    /// }
    /// assert!(world.body(paper)?.triangles().len() < 50, "it does not bear its own weight");
    /// # Ok::<(), tautline::Error>(())
    /// ```
    pub fn tear_at(mut self, strain: f32) -> Self {
        self.wish.wear.tear_at = Some(strain);
        self
    }

    /// Lets it get longer for good where it is strained beyond `yield_strain`, a share of its length: of what an edge is
    /// too long by, e^(−`rate` t) is left after the time t, with the rate in 1/s. It needs a [`Cloth::compliance`]. An edge
    /// never gets shorter again.
    ///
    /// ```
    /// use tautline::{Cloth, Settings, World};
    ///
    /// let mut world = World::new(Settings::default())?;
    /// let dough = Cloth::grid(4, 8, 0.1, 0.2).compliance(0.02).creep(0.01, 2.0).pin(0).pin(3);
    /// let dough = world.add(dough)?;
    /// let at_rest = |world: &World| world.body(dough).unwrap().sticks()[0].rest_length;
    /// let before = at_rest(&world);
    /// for _ in 0..60 {
    ///     world.step(1.0 / 60.0)?;
    /// }
    /// assert!(world.body(dough)?.sticks().iter().any(|stick| stick.rest_length > 1.05 * before));
    /// # Ok::<(), tautline::Error>(())
    /// ```
    pub fn creep(mut self, yield_strain: f32, rate: f32) -> Self {
        self.wish.wear.creep = Some(Creep { yield_strain, rate });
        self
    }

    /// Sews two particles together: they are drawn towards each other at 1 m/s and stay together, as the edges of flat
    /// panels of which a garment is made.
    pub fn seam(mut self, a: u32, b: u32) -> Self {
        self.wish.seams.push([a, b]);
        self
    }
}

impl Wish {
    pub(super) fn validate(&self) -> Result<(), Error> {
        for (field, coefficient) in [("drag", self.drag), ("lift", self.lift)] {
            if let Some(coefficient) = coefficient {
                within(field, coefficient, 0.0, 1e6, "a coefficient from 0 to 1e6")?;
            }
        }
        if let Some(pressure) = self.pressure {
            within("pressure", pressure, 0.0, 1e12, "a pressure from 0 to 1e12 (Pa)")?;
        }
        if let Some(rigidity) = self.bending_stiffness {
            within("bending_stiffness", rigidity, 1e-20, 1e12, "a rigidity from 1e-20 to 1e12 (N·m)")?;
        }
        for (field, compliance) in
            [("compliance", self.compliance), ("shear_compliance", self.shear_compliance)]
        {
            if let Some(compliance) = compliance {
                within(field, compliance, 0.0, 1e12, "a compliance from 0 to 1e12 (m/N)")?;
            }
        }
        if self.shear_compliance.is_some() && self.compliance.is_none() {
            let problem = "is of no use without a compliance".into();
            return Err(Error::Invalid { field: "shear_compliance".into(), problem });
        }
        if let Some(limit) = self.strain_limit {
            within("strain_limit", limit, 0.0, 1e3, "a share from 0 to 1000")?;
        }
        self.validate_wear()
    }

    fn validate_wear(&self) -> Result<(), Error> {
        let refuse =
            |field: &str, problem: &str| Error::Invalid { field: field.into(), problem: problem.into() };
        let stretches = self.compliance.is_some_and(|compliance| compliance > 0.0);
        const OF_NO_USE: &str =
            "is of no use without a compliance above 0: what does not stretch has no strain";
        if let Some(strain) = self.wear.tear_at {
            within("tear_at", strain, 1e-6, 1e3, "a share from 1e-6 to 1000")?;
            if !stretches {
                return Err(refuse("tear_at", OF_NO_USE));
            }
            if self.strain_limit.is_some_and(|limit| limit <= strain) {
                return Err(refuse("tear_at", "is never reached: the strain limit must be greater"));
            }
        }
        if let Some(Creep { yield_strain, rate }) = self.wear.creep {
            within("creep.yield_strain", yield_strain, 0.0, 1e3, "a share from 0 to 1000")?;
            within("creep.rate", rate, 0.0, 1e6, "a rate from 0 to 1e6 (1/s)")?;
            if !stretches {
                return Err(refuse("creep", OF_NO_USE));
            }
        }
        Ok(())
    }

    /// Whether all its sticks in one direction are alike, and none sews it up.
    pub(super) fn is_uniform(&self) -> bool {
        self.compliance.is_none()
            && self.strain_limit.is_none()
            && self.seams.is_empty()
            && self.wear.is_none()
    }

    /// Hinges that resist bending, of a mesh at rest. For an edge of length l between triangles of areas A, B l²/ΣA is
    /// what the angle is held with: exact for the bending of equilateral triangles in any direction, and of halved
    /// rectangles along their sides.
    pub(super) fn hinges(&self, half_edges: &HalfEdgeMesh, rest: &[Vec3]) -> Vec<Bending> {
        let Some(rigidity) = self.bending_stiffness else { return Vec::new() };
        let hinge = |[start, end, first, second]: [u32; 4]| {
            let [e0, e1, w0, w1] = [start, end, first, second].map(|corner| rest[corner as usize]);
            let (angle, _) = bending_gradient([w0, w1], [e0, e1])?;
            let area = 0.5 * ((e1 - e0).cross(w0 - e0).norm() + (e1 - e0).cross(w1 - e0).norm());
            let compliance = area / (rigidity * (e1 - e0).length_squared());
            Some(Bending {
                edge: [start, end],
                wings: [first, second],
                limit: AngleLimit::Target(angle),
                compliance,
            })
        };
        half_edges.hinges().filter_map(hinge).collect()
    }

    /// What a cloth of this surface becomes.
    pub(super) fn fabric(
        &self,
        mesh: &TriMesh,
        half_edges: &HalfEdgeMesh,
        sticks: &[Stick],
    ) -> Result<Fabric, Error> {
        let (drag, lift) = (self.drag.unwrap_or(0.0), self.lift.unwrap_or(0.0));
        let air = (drag > 0.0 || lift > 0.0).then_some(AirGrip { drag, lift });
        let gas = self.pressure.map(|pressure| gas_in(pressure, mesh, half_edges)).transpose()?;
        let compliances =
            self.compliance.map(|compliance| self.compliances(compliance, mesh, half_edges, sticks));
        let stretch = (compliances.is_some() || self.strain_limit.is_some())
            .then_some(Stretch { compliances, limit: self.strain_limit });
        let seams =
            self.seams.iter().zip(0..).map(|(seam, number)| seam_at_rest(*seam, number, &mesh.positions));
        let bends_by_stiffness = self.bending_stiffness.is_some();
        let seams = seams.collect::<Result<_, Error>>()?;
        Ok(Fabric { air, gas, stretch, bends_by_stiffness, wear: self.wear, seams })
    }

    /// Those of the edges, in m/N: for one of length l beside the area ΣA, α l²/ΣA, so that a lattice of equilateral
    /// triangles has Young's modulus times thickness 1/α, and rectangles along their sides. The diagonal of a sheared cell
    /// gets longer by γ ΣA/l, so that it has α ΣA/l² for an α of shear.
    fn compliances(
        &self,
        compliance: f32,
        mesh: &TriMesh,
        half_edges: &HalfEdgeMesh,
        sticks: &[Stick],
    ) -> Vec<f32> {
        let at = |corner: u32| mesh.positions[corner as usize];
        let of_edge = |(edge, stick): (u32, &Stick)| {
            let (first, second) = half_edges.opposite_vertices(edge);
            let along = at(stick.b) - at(stick.a);
            let area = |across: u32| 0.5 * along.cross(at(across) - at(stick.a)).norm();
            let shape = along.length_squared() / (area(first) + second.map_or(0.0, area)).max(1e-30);
            let is_diagonal = along.x != 0.0 && along.z != 0.0;
            match self.shear_compliance.filter(|_| is_diagonal) {
                Some(shear) => shear / shape,
                None => compliance * shape,
            }
        };
        (0..).zip(sticks).map(of_edge).collect()
    }
}

/// The speed at which seams are drawn together is the solver's; here is how far apart their ends are.
fn seam_at_rest([a, b]: [u32; 2], number: usize, positions: &[Vec3]) -> Result<Stick, Error> {
    let refuse =
        |problem: &str| Error::Invalid { field: format!("seams[{number}]"), problem: problem.into() };
    if a == b {
        return Err(refuse("sews a particle to itself"));
    }
    if a.max(b) as usize >= positions.len() {
        return Err(refuse("has an end that is the number of no particle"));
    }
    Ok(Stick::at_rest(a, b, positions))
}

fn gas_in(pressure: f32, mesh: &TriMesh, half_edges: &HalfEdgeMesh) -> Result<Gas, Error> {
    let refuse = |problem: &str| Error::Invalid { field: "pressure".into(), problem: problem.into() };
    if !half_edges.closed() {
        return Err(refuse("needs a closed surface: gas would escape from this one"));
    }
    let volume = volume_of(&mesh.triangles, &mesh.positions);
    if volume > 0.0 && volume.is_finite() {
        return Ok(Gas { pressure, volume });
    }
    Err(refuse("needs a surface that holds a volume, its triangles counter-clockwise seen from outside"))
}
