//! Where the nodes of a scene put its meshes.

use std::borrow::Cow;

use tautline::DVec3;

use super::super::{Limits, Refusal};
use super::document::{Document, Node};

/// A mesh at a place.
pub(super) struct Instance {
    pub(super) mesh: usize,
    /// The node that shows it.
    pub(super) node: usize,
    pub(super) placement: Placement,
}

/// An affine map: what becomes of the axes, and of the origin.
#[derive(Clone, Copy)]
pub(super) struct Placement {
    axes: [DVec3; 3],
    origin: DVec3,
}

/// Visits every mesh of the scene where a node puts it, in the order of a walk from the roots; of a file without nodes,
/// every mesh where it is.
pub(super) fn for_each_instance(
    document: &Document,
    limits: &Limits,
    mut visit: impl FnMut(&Instance) -> Result<(), Refusal>,
) -> Result<(), Refusal> {
    if document.nodes.is_empty() {
        let still = |mesh| Instance { mesh, node: 0, placement: Placement::IDENTITY };
        return (0..document.meshes.len()).try_for_each(|mesh| visit(&still(mesh)));
    }
    let roots = roots(document)?;
    let mut is_visited = vec![false; document.nodes.len()];
    // A node of each level, and those of its children that are still to come: as long as the walk is deep, not as it is wide.
    let mut path = vec![(Placement::IDENTITY, roots.iter())];
    while let Some((above, children)) = path.last_mut() {
        let Some(&number) = children.next() else {
            path.pop();
            continue;
        };
        let refuse = |message: String| Refusal::at_field(format!("nodes[{number}]"), message);
        let node = number as usize;
        let Some(known) = document.nodes.get(node) else {
            return Err(refuse(format!("there are only {} nodes", document.nodes.len())));
        };
        if std::mem::replace(&mut is_visited[node], true) {
            return Err(refuse(
                "it comes twice: as a child of two nodes, of itself or of its own child".into(),
            ));
        }
        let placement = above.then(&Placement::of(known));
        if path.len() > limits.nesting {
            return Err(refuse(format!("nodes below each other more than {} deep", limits.nesting)));
        }
        if let Some(mesh) = known.mesh {
            let mesh = mesh as usize;
            if mesh >= document.meshes.len() {
                let message = format!("mesh {mesh}, but there are only {}", document.meshes.len());
                return Err(Refusal::at_field(format!("nodes[{number}].mesh"), message));
            }
            visit(&Instance { mesh, node, placement })?;
        }
        path.push((placement, known.children.iter()));
    }
    Ok(())
}

/// The nodes that the scene begins with; without scenes, those that are no one's children.
fn roots(document: &Document) -> Result<Cow<'_, [u32]>, Refusal> {
    if document.scenes.is_empty() {
        let mut is_child = vec![false; document.nodes.len()];
        for &child in document.nodes.iter().flat_map(|node| &node.children) {
            if let Some(known) = is_child.get_mut(child as usize) {
                *known = true;
            }
        }
        return Ok((0..document.nodes.len() as u32).filter(|&node| !is_child[node as usize]).collect());
    }
    let scene = document.scene.unwrap_or(0);
    let known = document.scenes.get(scene as usize).ok_or_else(|| {
        Refusal::at_field("scene", format!("{scene}, but there are only {} scenes", document.scenes.len()))
    })?;
    Ok(Cow::Borrowed(&known.nodes))
}

impl Placement {
    const IDENTITY: Self = Self { axes: [DVec3::X, DVec3::Y, DVec3::Z], origin: DVec3::ZERO };

    fn of(node: &Node) -> Self {
        if let Some(m) = &node.matrix {
            let column = |i: usize| DVec3::new(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
            return Self { axes: [column(0), column(1), column(2)], origin: column(3) };
        }
        let [x, y, z, w] = node.rotation.as_deref().copied().unwrap_or([0.0, 0.0, 0.0, 1.0]);
        let scale = node.scale.as_deref().map_or(DVec3::ONE, |&scale| scale.into());
        Self {
            axes: [
                DVec3::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y))
                    * scale.x,
                DVec3::new(2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x))
                    * scale.y,
                DVec3::new(2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y))
                    * scale.z,
            ],
            origin: node.translation.as_deref().map_or(DVec3::ZERO, |&translation| translation.into()),
        }
    }

    /// The map that applies `inner` first.
    fn then(&self, inner: &Self) -> Self {
        Self { axes: inner.axes.map(|axis| self.turn(axis)), origin: self.apply(inner.origin) }
    }

    fn turn(&self, direction: DVec3) -> DVec3 {
        self.axes[0] * direction.x + self.axes[1] * direction.y + self.axes[2] * direction.z
    }

    pub(super) fn apply(&self, point: DVec3) -> DVec3 {
        self.turn(point) + self.origin
    }

    /// Whether it turns surfaces inside out.
    pub(super) fn is_mirrored(&self) -> bool {
        let [x, y, z] = self.axes;
        x.cross(y).dot(z) < 0.0
    }
}
