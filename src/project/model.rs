//! What a project file says, checked and in SI units: the model that every stage projects its
//! small input from.
//!
//! Lengths in metres, angles in radians (degrees exist only in the file), masses in kilograms,
//! stresses in pascals. Names keep the order of the file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A whole project.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Project {
    /// `[project] name`; names the output folder and the title blocks.
    pub name: String,
    /// `[surface]`.
    pub surface: Surface,
    /// `[points]`, in the order of the file.
    pub points: Vec<Point>,
    /// `[patches]`, in the order of the file.
    pub patches: Vec<Patch>,
    /// `[distribution]`.
    pub distribution: Distribution,
    /// Every material that a lamella or a study names, built in or of `[materials]`, by name.
    pub materials: Vec<Material>,
    /// `[split]`.
    pub split: Split,
    /// `[supports]`.
    pub supports: Supports,
    /// `[hardware]`.
    pub hardware: Hardware,
    /// `[fabrication]`.
    pub fabrication: Fabrication,
    /// `[simulation]`.
    pub simulation: Simulation,
    /// `[[studies]]`.
    pub studies: Vec<Study>,
    /// `[lints]`: names of lints that are allowed, sorted.
    pub allowed_lints: Vec<String>,
}

/// The design surface: which file, and how to read it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// Path as written, relative to the project file, `/` between its parts. It may hold `..`;
    /// whether it stays within the repository only the file system can tell.
    pub mesh: String,
    /// Metres per unit of the mesh, the factor `scale` included.
    pub metres_per_unit: f64,
    /// Which axis of the mesh points up.
    pub up: Axis,
    /// Turn all faces over.
    pub flip: bool,
}

/// An axis of the mesh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// x.
    X,
    /// y, the habit of modelling programs for games.
    Y,
    /// z, the default.
    Z,
}

/// A named anchor on the surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// The user's name.
    pub name: String,
    /// Where it is.
    pub anchor: Anchor,
}

/// How an anchor is found on the surface. Coordinates are in metres, z up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Anchor {
    /// The topmost surface point over (x, y).
    Above([f64; 2]),
    /// The closest point of the surface.
    Near([f64; 3]),
    /// A vertex of the mesh file, counted from 0 in the order of the file's `v` records.
    Vertex(u32),
    /// On the shortest geodesic between two other anchors.
    On {
        /// Names of the two anchors.
        edge: [String; 2],
        /// Share of its length from the first.
        at: f64,
    },
}

/// A geodesic quadrilateral.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Patch {
    /// The user's name.
    pub name: String,
    /// Names of its four anchors in order around it.
    pub corners: [String; 4],
    /// Members of the u-family, boundary members included. A loaded project has every count: of
    /// the patch itself, of its strip, or computed across a T-junction.
    pub u: Option<u32>,
    /// Members of the v-family, likewise.
    pub v: Option<u32>,
    /// Planar angle at the first corner, radians; `None` lets the compiler choose.
    pub alpha: Option<f64>,
    /// Lamellae of this patch, overrides applied.
    pub lamella: Lamella,
}

/// Cross-section and material of a lamella.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Lamella {
    /// Metres.
    pub width: f64,
    /// Metres.
    pub thickness: f64,
    /// Name of a material in [`Project::materials`].
    pub material: String,
}

/// `[distribution]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Distribution {
    /// Weight of a side (two anchors) in the even distribution; 1 where unsaid.
    pub weights: Vec<([String; 2], f64)>,
    /// Patches whose named family's strip shall close into a ring, with the family.
    pub closed: Vec<(String, Family)>,
}

/// One of the two families of members.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Family {
    /// From side 1-2 to side 4-3.
    U,
    /// From side 1-4 to side 2-3.
    V,
}

/// A material, SI.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Its name.
    pub name: String,
    /// Young's modulus along the lamella, Pa.
    pub elastic_modulus: f64,
    /// Shear modulus, Pa.
    pub shear_modulus: f64,
    /// kg/m^3.
    pub density: f64,
    /// Bending strength, Pa.
    pub bending_strength: f64,
    /// Price of a square metre of sheet, in the project's one currency.
    pub price: Option<f64>,
    /// Which way the grain runs in a lamella.
    pub grain: Grain,
}

/// Grain of a lamella.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Grain {
    /// Along the lamella: the usual case, and the stiff one.
    Along,
    /// Across it.
    Across,
    /// No grain (metal, plastics).
    None,
}

/// `[split]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Split {
    /// Which workflow.
    pub workflow: Workflow,
    /// Largest feasible eta (paper, section 4.1).
    pub eta_max: f64,
    /// Bounds of the slopes of cladding functions.
    pub slope: [f64; 2],
    /// Shortest side that splitting may make, metres.
    pub min_side: Option<f64>,
    /// Most patches that splitting may make.
    pub max_patches: Option<u32>,
    /// Longest side that splitting leaves patches with, metres.
    pub max_side: Option<f64>,
}

/// How patches are split.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Workflow {
    /// Patches are taken as they are and checked.
    Off,
    /// Algorithm 1 of the paper.
    Automatic,
    /// Algorithm 2 of the paper.
    Informed,
}

/// `[supports]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Supports {
    /// Where.
    pub at: SupportPlaces,
    /// What.
    pub kind: SupportKind,
    /// Height of the lowest contact face above the ground, metres; 0: as low as supports can be.
    pub height: f64,
}

/// Where supports stand.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub enum SupportPlaces {
    /// At the corners of the patches along the rim.
    Corners,
    /// At every crossing on the rim.
    EveryBoundaryCrossing,
    /// At the listed points or crossings.
    Listed(Vec<String>),
}

/// What a support is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SupportKind {
    /// A printed foot.
    Printed,
    /// A cast block with an inclined face.
    ConcreteBlock,
    /// A wooden wedge on a cast block.
    WedgeOnBlock,
}

/// `[hardware]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Hardware {
    /// The bolt through each crossing.
    pub bolt: Bolt,
    /// Sticker foil, if any.
    pub sticker: Option<Sticker>,
    /// Brass shell in the notch, if any.
    pub shell: Option<Shell>,
}

/// A metric bolt.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Bolt {
    /// `M4`.
    pub name: String,
    /// Nominal diameter, metres.
    pub diameter: f64,
}

/// Friction-reducing foil at notches.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sticker {
    /// Name of the foil.
    pub foil: String,
    /// Metres.
    pub thickness: f64,
    /// Margin around the contact area, metres.
    pub margin: f64,
    /// Length and width of a sheet of foil, metres.
    pub sheet: [f64; 2],
}

/// A tube around the bolt.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Shell {
    /// As written: `brass 5x0.5`.
    pub name: String,
    /// Outer diameter, metres.
    pub diameter: f64,
    /// Wall, metres.
    pub wall: f64,
}

/// `[fabrication]`. Lengths in metres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Fabrication {
    /// The panel that is bought; grain along the length.
    pub stock: Stock,
    /// The machine's bed, where it is smaller than the panel.
    pub bed: Option<Bed>,
    /// Width that the beam removes; 0 draws nominal geometry.
    pub kerf: f64,
    /// Play of the shell or bolt in its opening.
    pub clearance: f64,
    /// Least distance between parts on a sheet.
    pub spacing: f64,
    /// Border of the sheet that stays free.
    pub margin: f64,
    /// From the last crossing's centre to the end of a lamella; `None` takes the width of the
    /// lamella.
    pub end_margin: Option<f64>,
    /// Height of engraved labels.
    pub label_height: f64,
    /// Which colours and layer names.
    pub colours: ColourPreset,
    /// Splice joint for lamellae longer than the stock; `None` forbids splices.
    pub splice: Option<SpliceKind>,
}

/// A panel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Stock {
    /// Along the grain, metres.
    pub length: f64,
    /// Across the grain, metres.
    pub width: f64,
    /// Price of one panel, in the project's currency.
    pub price: Option<f64>,
}

/// A machine bed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Bed {
    /// Metres.
    pub length: f64,
    /// Metres.
    pub width: f64,
    /// Whether a longer panel can be pushed through.
    pub pass_through: bool,
}

/// Colour and layer conventions of cut files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ColourPreset {
    /// Red cuts, blue scores, black engraves.
    RedCut,
    /// Blue cuts, red scores, black engraves.
    BlueCut,
    /// A colour for every layer, for shops that go by the layers' names: red outlines, blue
    /// openings, green scores, black engraves.
    ByLayer,
}

/// How a long lamella is joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SpliceKind {
    /// In-plane fingers, cut and glued.
    Finger,
    /// Across the thickness, marked.
    Scarf,
    /// Butt joint with a lapped plate.
    Plate,
}

/// `[simulation]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Simulation {
    /// m/s^2.
    pub gravity: [f64; 3],
    /// Patches share their common lamellae.
    pub connect_patches: bool,
}

/// One of `[[studies]]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// Factors of size.
    pub scale: Vec<f64>,
    /// Names of materials; empty keeps the project's.
    pub materials: Vec<String>,
}
