//! Work that stays local to a patch: the part of the surface around it, and the proof that no
//! shortest geodesic leaves it.

use super::domain::Outline;
use super::{Domain, Side, vertices_inside};
use crate::geodesic::{GeodesicError, Geodesics, Reach};
use crate::project::model::Family;
use crate::surface::{Clearance, Mesh, SubMesh, SurfacePoint, grow};

/// Margins around a patch that are tried in turn, in shares of its longest side.
const MARGINS: [f64; 3] = [0.15, 0.3, 0.6];
/// A part with more of the surface than this is taken as the whole: nothing would be saved.
const WHOLE: f64 = 0.7;
/// Sampled geodesics have to be this much shorter than any detour, so that those in between are
/// too; each one is checked again where it is used.
const SLACK: f64 = 1.02;

/// Four sides on the whole surface.
#[derive(Debug, Clone)]
pub struct Quad {
    /// From A to B.
    pub ab: Side,
    /// From B to C.
    pub bc: Side,
    /// From D to C.
    pub dc: Side,
    /// From A to D.
    pub ad: Side,
}

impl Quad {
    fn outline<'a>(&'a self, surface: &'a Mesh) -> Outline<'a> {
        Outline {
            mesh: surface,
            ab: &self.ab,
            bc: &self.bc,
            dc: &self.dc,
            ad: &self.ad,
        }
    }

    fn on_part(&self, surface: &Mesh, part: SubMesh) -> Option<Domain> {
        let [ab, bc, dc, ad] =
            [&self.ab, &self.bc, &self.dc, &self.ad].map(|side| side.on_part(surface, &part));
        Some(Domain {
            ab: ab?,
            bc: bc?,
            dc: dc?,
            ad: ad?,
            part,
        })
    }
}

impl Domain {
    /// The domain of a patch: the smallest part of the surface, of a few that are tried, in which
    /// its geodesics are provably shortest.
    pub fn around(surface: &Mesh, quad: Quad) -> Result<Self, GeodesicError> {
        // Nothing here but the last resort takes the whole surface into its hands: a patch costs what
        // it measures, however many others there are.
        let mut seeds = quad.outline(surface).ring();
        let inside = vertices_inside(surface, &seeds, quad.outline(surface).turns_left());
        seeds.extend(inside.into_iter().map(SurfacePoint::Vertex));
        let sides = [&quad.ab, &quad.bc, &quad.dc, &quad.ad];
        let longest = sides.iter().map(|side| side.length()).fold(0.0, f64::max);
        for margin in MARGINS {
            let faces = grow(surface, &seeds, margin * longest);
            if faces.len() as f64 > WHOLE * f64::from(surface.face_count()) {
                break;
            }
            let part = SubMesh::new(surface, &faces);
            if let Some(domain) = quad.on_part(surface, part)
                && domain.is_wide_enough()?
            {
                return Ok(domain);
            }
        }
        let all: Vec<u32> = (0..surface.face_count()).collect();
        let Quad { ab, bc, dc, ad } = quad;
        Ok(Self {
            part: SubMesh::new(surface, &all),
            ab,
            bc,
            dc,
            ad,
        })
    }

    /// Whether sampled geodesics between opposite sides are shorter than any way that leaves the
    /// part.
    fn is_wide_enough(&self) -> Result<bool, GeodesicError> {
        let mesh = self.mesh();
        let geodesics = Geodesics::new(mesh);
        let proof = Proof::new(self);
        for family in [Family::U, Family::V] {
            let sample = |side: &Side| [0.0, 0.5, 1.0].map(|share| side.at(mesh, share));
            let ends = sample(self.end(family));
            for start in sample(self.start(family)) {
                let field = geodesics.field(&start, Reach::Targets(&ends))?;
                for end in &ends {
                    if !proof.holds(&start, end, SLACK * field.distance(end)?) {
                        return Ok(false);
                    }
                }
            }
        }
        Ok(true)
    }
}

/// Proves that geodesics of a domain are shortest on the whole surface.
#[derive(Debug)]
pub struct Proof<'a> {
    domain: &'a Domain,
    clearance: Clearance,
}

impl<'a> Proof<'a> {
    /// Looks up where the part was cut out.
    pub fn new(domain: &'a Domain) -> Self {
        Self {
            domain,
            clearance: domain.part.clearance(),
        }
    }

    /// Whether a way of this length, metres, between two points of the part is no longer than any
    /// that leaves the part.
    pub fn holds(&self, from: &SurfacePoint, to: &SurfacePoint, length: f64) -> bool {
        let mesh = self.domain.mesh();
        let [from, to] = [from, to].map(|p| self.clearance.distances(&p.position(mesh)));
        length <= Clearance::detour(&from, &to)
    }
}
