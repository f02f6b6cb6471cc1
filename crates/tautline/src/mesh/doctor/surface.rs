//! What the sound triangles of a mesh make together.

use glam::DVec3;

use super::edges::{Side, by_edge, corners_at, partners, sides};
use super::groups::Groups;
use super::loops::chains;
use super::nesting::depths;
use super::orient::{Orientation, orientation};
use super::{Component, Defect};
use crate::mesh::TriMesh;
use crate::order::PutInOrder;

/// Triangles and how they hang together.
pub(super) struct Surface<'a> {
    triangles: &'a [[u32; 3]],
    /// Which of them take part.
    included: Vec<bool>,
    points: Vec<DVec3>,
    /// The lowest vertex at the place of each.
    place: Vec<u32>,
    sides: Vec<Side>,
    partners: Vec<u32>,
    orientation: Orientation,
}

impl<'a> Surface<'a> {
    /// The triangles that are included must have three different corners that are there.
    pub(super) fn new(mesh: &'a TriMesh, included: Vec<bool>) -> Self {
        let sides = sides(&mesh.triangles, &included);
        let partners = partners(&mesh.triangles, &sides);
        Self {
            triangles: &mesh.triangles,
            included,
            // −0 + 0 is +0.
            points: mesh.positions.iter().map(|position| position.as_dvec3() + DVec3::ZERO).collect(),
            place: places(mesh),
            orientation: orientation(&mesh.triangles, &partners),
            sides,
            partners,
        }
    }

    pub(super) fn included(&self) -> &[bool] {
        &self.included
    }

    pub(super) fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The triangles, with one number for every place. What does not take part is left as it is.
    pub(super) fn welded_triangles(&self) -> Vec<[u32; 3]> {
        let weld = |(&triangle, &included): (&[u32; 3], &bool)| {
            if included { triangle.map(|vertex| self.place[vertex as usize]) } else { triangle }
        };
        self.triangles.iter().zip(&self.included).map(weld).collect()
    }

    /// Vertices at one place, where open edges lie on open edges.
    pub(super) fn unwelded(&self) -> Vec<Defect> {
        let place = |vertex: u32| self.place[vertex as usize];
        let mut open: Vec<([u32; 2], [u32; 2])> = self
            .open()
            .into_iter()
            .map(|[a, b]| {
                let (a, b) = if place(a) <= place(b) { (a, b) } else { (b, a) };
                ([place(a), place(b)], [a, b])
            })
            .collect();
        open.put_in_order();
        let torn = open.chunk_by(|x, y| x.0 == y.0).filter(|edges| edges.len() > 1);
        let mut at_place: Vec<(u32, u32)> =
            torn.flatten().flat_map(|(places, ends)| [(places[0], ends[0]), (places[1], ends[1])]).collect();
        at_place.put_in_order();
        at_place.dedup();
        let groups = at_place.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1);
        groups
            .map(|group| Defect::Unwelded { vertices: group.iter().map(|&(_, vertex)| vertex).collect() })
            .collect()
    }

    pub(super) fn non_manifold_edges(&self) -> impl Iterator<Item = Defect> {
        by_edge(&self.sides).filter(|sharing| sharing.len() > 2).map(|sharing| Defect::NonManifoldEdge {
            edge: [sharing[0].a, sharing[0].b],
            triangles: sharing.iter().map(Side::triangle).collect(),
        })
    }

    /// Triangles that face the other way than their patch, and edges where no turning helps.
    pub(super) fn turned_wrong(&self) -> impl Iterator<Item = Defect> {
        let flipped = (0..self.triangles.len()).filter(|&triangle| self.orientation.is_flipped[triangle]);
        let one_sided = self.orientation.conflicts.iter().map(|&half_edge| {
            let corners = self.triangles[half_edge as usize / 3];
            let k = half_edge as usize % 3;
            Defect::OneSided { edge: [corners[k], corners[(k + 1) % 3]] }
        });
        flipped.map(|triangle| Defect::Flipped { triangle: triangle as u32 }).chain(one_sided)
    }

    /// Vertices whose corners are not all joined by edges.
    pub(super) fn bow_ties(&self) -> Vec<Defect> {
        let mut corners = Groups::new(3 * self.triangles.len());
        for sharing in by_edge(&self.sides) {
            for other in &sharing[1..] {
                for end in [sharing[0].a, sharing[0].b] {
                    let corner = |side: &Side| corners_at(self.triangles, side.half_edge, end);
                    corners.join(corner(&sharing[0]), corner(other));
                }
            }
        }
        let mut fans = vec![0_usize; self.points.len()];
        for (corner, &vertex) in self.triangles.as_flattened().iter().enumerate() {
            if self.included[corner / 3] && corners.find(corner as u32) as usize == corner {
                fans[vertex as usize] += 1;
            }
        }
        let several = fans.into_iter().zip(0..).filter(|&(fans, _)| fans > 1);
        several.map(|(fans, vertex)| Defect::BowTie { vertex, fans }).collect()
    }

    /// The open edges, in the direction of their triangles.
    pub(super) fn open(&self) -> Vec<[u32; 2]> {
        let alone = by_edge(&self.sides).filter(|sharing| sharing.len() == 1).map(|sharing| sharing[0]);
        alone
            .map(|side| if side.is_forward(self.triangles) { [side.a, side.b] } else { [side.b, side.a] })
            .collect()
    }

    pub(super) fn open_edges(&self) -> impl Iterator<Item = Defect> {
        let chains = chains(&self.open(), self.points.len()).into_iter();
        chains.map(|chain| Defect::Open { vertices: chain.vertices, is_loop: chain.is_loop })
    }

    /// What hangs together by edges, and what of it is inside out.
    pub(super) fn components(&self) -> (Vec<Component>, Vec<Defect>) {
        let first = self.first_of_component();
        let mut components: Vec<Component> = Vec::new();
        let mut number = vec![u32::MAX; self.triangles.len()];
        for triangle in (0..self.triangles.len()).filter(|&triangle| self.included[triangle]) {
            let first_triangle = first[triangle];
            if first_triangle as usize == triangle {
                number[triangle] = components.len() as u32;
                components.push(Component { first_triangle, triangles: 0, is_closed: true, volume: 0.0 });
            }
            number[triangle] = number[first_triangle as usize];
            let component = &mut components[number[triangle] as usize];
            component.triangles += 1;
            component.volume += self.volume_under(triangle, first_triangle as usize);
            component.is_closed &=
                (3 * triangle..3 * triangle + 3).all(|half_edge| self.partners[half_edge] != u32::MAX);
        }
        self.orientation.conflicts.iter().for_each(|&half_edge| {
            components[number[half_edge as usize / 3] as usize].is_closed = false;
        });
        components
            .iter_mut()
            .filter(|component| !component.is_closed)
            .for_each(|component| component.volume = 0.0);
        let inside_out = self.inside_out(&components, &number);
        (components, inside_out)
    }

    /// The lowest triangle of the component of each.
    pub(super) fn first_of_component(&self) -> Vec<u32> {
        let mut groups = Groups::new(self.triangles.len());
        for sharing in by_edge(&self.sides) {
            sharing[1..].iter().for_each(|side| groups.join(sharing[0].triangle(), side.triangle()));
        }
        (0..self.triangles.len() as u32).map(|triangle| groups.find(triangle)).collect()
    }

    /// The signed volume between a triangle, turned as its patch is, and the first corner of its component.
    fn volume_under(&self, triangle: usize, first: usize) -> f64 {
        let origin = self.points[self.triangles[first][0] as usize];
        let [a, b, c] = self.triangles[triangle].map(|vertex| self.points[vertex as usize] - origin);
        let volume = a.cross(b).dot(c) / 6.0;
        if self.orientation.is_flipped[triangle] { -volume } else { volume }
    }

    /// A component inside an even number of others must face outwards, inside an odd number inwards. One whose number is
    /// not known is taken as it is.
    fn inside_out(&self, components: &[Component], number: &[u32]) -> Vec<Defect> {
        let closed =
            |number: u32| components.get(number as usize).is_some_and(|component| component.is_closed);
        let surface: Vec<Option<u32>> =
            number.iter().map(|&number| closed(number).then_some(number)).collect();
        let depths = |asked: &[(u32, u32)]| depths(&self.points, self.triangles, &surface, asked);
        let vertex = |triangle: u32| self.triangles[triangle as usize][0];
        let asked: Vec<(u32, u32)> = (0..components.len() as u32)
            .filter(|&number| closed(number))
            .map(|number| (vertex(components[number as usize].first_triangle), number))
            .collect();
        let is_odd = |depth: u32| depth % 2 == 1;
        let mut is_within = vec![Some(false); components.len()];
        for (&(_, number), depth) in asked.iter().zip(depths(&asked)) {
            is_within[number as usize] = depth.map(is_odd);
        }
        // What crosses another is not inside it as a whole: it faces outwards.
        let within = (0..self.triangles.len() as u32)
            .filter(|&t| self.included[t as usize] && is_within[number[t as usize] as usize] == Some(true));
        let asked: Vec<(u32, u32)> = within.map(|t| (vertex(t), number[t as usize])).collect();
        for (&(_, number), depth) in asked.iter().zip(depths(&asked)) {
            let is_known = is_within[number as usize].zip(depth);
            is_within[number as usize] = is_known.map(|(is_within, depth)| is_within && is_odd(depth));
        }
        let wrong = components.iter().zip(is_within).filter(|(component, is_within)| {
            component.is_closed && is_within.is_some_and(|is_within| is_within != (component.volume < 0.0))
        });
        wrong.map(|(component, _)| Defect::InsideOut { triangle: component.first_triangle }).collect()
    }
}

/// The lowest vertex at the place of each.
fn places(mesh: &TriMesh) -> Vec<u32> {
    let bits =
        |vertex: u32| (mesh.positions[vertex as usize] + glam::Vec3::ZERO).to_array().map(f32::to_bits);
    let mut order: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    order.put_in_order_by_key(|&vertex| bits(vertex));
    let mut place = vec![0; mesh.positions.len()];
    for same in order.chunk_by(|&a, &b| bits(a) == bits(b)) {
        same.iter().for_each(|&vertex| place[vertex as usize] = same[0]);
    }
    place
}
