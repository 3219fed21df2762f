//! The shape of a project file: what may be written where, in the file's own terms.
//!
//! These types are the one source of three things: the reader (`section!` takes a table apart
//! by the names of the fields), the JSON schema (`schemars` turns fields into properties and doc
//! comments into the hover text of editors) and the input of [`check`](super::check), which
//! gives them meaning. A field is `Field<T>` where the file must have it, `Option<Field<T>>`
//! where a default exists; the default stands in the field's `extend("default" = ..)`.

pub(crate) mod anchors;
pub(crate) mod choices;
pub(crate) mod collections;
pub(crate) mod hardware;
pub(crate) mod intervals;
pub(crate) mod quantity;
pub(crate) mod reader;
pub(crate) mod words;

use crate::diagnostics::KeyPath;
use crate::project::model::{Axis, ColourPreset, Grain, SupportKind, Workflow};
use anchors::{Alpha, AnchorFile, LamellaFile, SupportPlacesFile};
use choices::{LengthUnit, Pick, Splicing};
use collections::{Exactly, List, Materials, Named, OneOrMany, Patches, Points, Sides};
use hardware::{BoltName, TubeName};
use intervals::{
    Eta, Extent, Factor, FoilThickness, Gap, Heaviness, KerfWidth, Modulus, Money, Play, Pull,
    Slope, Strength, StudyFactor, TextHeight, Weight,
};
use quantity::{Length, OfAcceleration, OfDensity, OfStress, Plain, Quantity};
use reader::{Field, section};
use schemars::JsonSchema;
use words::{Count, FamilyName, Format, Label, MeshPath, Name, Reference};

/// A project of `egg`: one structure of elastic geodesic grids. Bare lengths are in
/// `project.units`, bare angles in degrees, the rest in SI; a string carries its own unit, such
/// as `"3 mm"` or `"7.6 GPa"`.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields, title = "egg project")]
pub(crate) struct ProjectFile {
    /// The project itself.
    pub(crate) project: Option<Field<ProjectSection>>,
    /// The design surface.
    pub(crate) surface: Field<SurfaceSection>,
    /// Named anchors on the surface; a patch needs four.
    pub(crate) points: Field<Named<Points, AnchorFile>>,
    /// Named geodesic quadrilaterals between anchors, at least one.
    pub(crate) patches: Field<Named<Patches, PatchFile>>,
    /// How members are distributed over the patches.
    pub(crate) distribution: Option<Field<DistributionSection>>,
    /// Cross-section and material of the lamellae.
    pub(crate) lamella: Field<LamellaFile>,
    /// Materials beside the built-in ones, which `egg materials` lists.
    pub(crate) materials: Option<Field<Named<Materials, MaterialFile>>>,
    /// Splitting of patches that cannot be built in one piece.
    pub(crate) split: Option<Field<SplitSection>>,
    /// Supports of the structure.
    pub(crate) supports: Option<Field<SupportsSection>>,
    /// Bolts, stickers, shells.
    pub(crate) hardware: Option<Field<HardwareSection>>,
    /// Stock, machine and drawing conventions.
    pub(crate) fabrication: Option<Field<FabricationSection>>,
    /// The mechanical simulation.
    pub(crate) simulation: Option<Field<SimulationSection>>,
    /// Studies of size and material, at most 50.
    pub(crate) studies: Option<Field<List<StudyFile, 0, 50>>>,
    /// Lints that this project allows.
    pub(crate) lints: Option<Field<LintsSection>>,
}

section!(ProjectFile {
    project,
    surface,
    points,
    patches,
    distribution,
    lamella,
    materials,
    split,
    supports,
    hardware,
    fabrication,
    simulation,
    studies,
    lints,
});

/// The project itself.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct ProjectSection {
    /// Version of this language. Default 1, the only one.
    #[schemars(extend("default" = 1))]
    #[expect(dead_code, reason = "reading it checks all there is to it")]
    pub(crate) format: Option<Field<Format>>,
    /// Name of the structure: letters, digits, `_` and `-`, at most 40. It names the output
    /// folder and the title blocks. Default: the name of the file.
    pub(crate) name: Option<Field<Name>>,
    /// Unit of bare lengths. Default mm.
    #[schemars(extend("default" = "mm"))]
    pub(crate) units: Option<Field<Pick<LengthUnit>>>,
}

section!(ProjectSection {
    format,
    name,
    units
});

/// The design surface: a mesh file and how to read it.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct SurfaceSection {
    /// Path of an OBJ file relative to the project file, with `/` between its parts. Polygons
    /// are cut into triangles.
    pub(crate) mesh: Field<MeshPath>,
    /// Unit of the mesh. Default: `project.units`.
    pub(crate) units: Option<Field<Pick<LengthUnit>>>,
    /// Factor that enlarges the mesh, 1e-6 to 1e6. Points are not scaled. Default 1.
    #[schemars(extend("default" = 1))]
    pub(crate) scale: Option<Field<Plain<Factor>>>,
    /// Axis of the mesh that points up. Default z.
    #[schemars(extend("default" = "z"))]
    pub(crate) up: Option<Field<Pick<Axis>>>,
    /// Turn all faces over, which swaps inside and outside. Default false.
    #[schemars(extend("default" = false))]
    pub(crate) flip: Option<Field<bool>>,
}

section!(SurfaceSection {
    mesh,
    units,
    scale,
    up,
    flip
});

/// A geodesic quadrilateral: four anchors, the members between them, the planar angle.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct PatchFile {
    /// Four names of `points`, in order around the patch. u-members run from side 1-2 to side
    /// 4-3, v-members from side 1-4 to side 2-3. Patches that name the same two anchors share
    /// that side.
    pub(crate) corners: Field<Exactly<Reference, 4>>,
    /// Members per family. A count may be left out where another patch of the strip gives it.
    pub(crate) members: Option<Field<MembersFile>>,
    /// Planar angle at the first corner, more than 0 and less than 180 degrees, or `"auto"`: the
    /// compiler chooses a compact plan. Default `"auto"`.
    #[schemars(extend("default" = "auto"))]
    pub(crate) alpha: Option<Field<Alpha>>,
}

section!(PatchFile {
    corners,
    members,
    alpha
});

/// Least and most members of a family: its two boundary members, and more than any structure of
/// the paper's kind has.
pub(crate) type MemberCount = Count<2, 1000>;

/// Members per family.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct MembersFile {
    /// Members from side 1-2 to side 4-3, the two boundary members included: 2 to 1000.
    pub(crate) u: Option<Field<MemberCount>>,
    /// Members from side 1-4 to side 2-3, the two boundary members included: 2 to 1000.
    pub(crate) v: Option<Field<MemberCount>>,
}

section!(MembersFile { u, v });

/// The even distribution of members.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct DistributionSection {
    /// Importance of sides in the distribution, by the two anchors: `"a-d" = 2`. More than 0,
    /// at most 1e6. Default 1 for every side.
    pub(crate) weights: Option<Field<Named<Sides, Plain<Weight>>>>,
    /// Families whose strip of patches is a ring and whose members shall end where they began:
    /// `[`"west.u"`]`, one family a ring. The automatic angles of its patches are chosen together for
    /// that. Default none.
    pub(crate) closed: Option<Field<List<FamilyName, 0, 2000>>>,
}

section!(DistributionSection { weights, closed });

/// A material. Bare numbers are in SI: Pa and kg/m^3.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct MaterialFile {
    /// Young's modulus along the lamella, such as `"7.6 GPa"`.
    pub(crate) elastic_modulus: Field<Quantity<OfStress, Modulus>>,
    /// Shear modulus, such as `"0.5 GPa"`.
    pub(crate) shear_modulus: Field<Quantity<OfStress, Modulus>>,
    /// Density, such as `"430 kg/m^3"`.
    pub(crate) density: Field<Quantity<OfDensity, Heaviness>>,
    /// Bending strength, such as `"40 MPa"`.
    pub(crate) bending_strength: Field<Quantity<OfStress, Strength>>,
    /// Price of a square metre of sheet, in any one currency for the whole project. Default:
    /// unknown.
    pub(crate) price: Option<Field<Plain<Money>>>,
    /// Which way the grain of the face runs in a lamella. Default `"along"`, with a warning:
    /// across the grain wood has a fifth of the stiffness.
    #[schemars(extend("default" = "along"))]
    pub(crate) grain: Option<Field<Pick<Grain>>>,
}

section!(MaterialFile {
    elastic_modulus,
    shear_modulus,
    density,
    bending_strength,
    price,
    grain,
});

/// Splitting of patches.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct SplitSection {
    /// Default `"off"`.
    #[schemars(extend("default" = "off"))]
    pub(crate) workflow: Option<Field<Pick<Workflow>>>,
    /// Largest detour of a geodesic over a peak of curvature that counts as feasible, 1 to 2.
    /// Default 1.0015, the paper's.
    #[schemars(extend("default" = 1.0015))]
    pub(crate) eta_max: Option<Field<Plain<Eta>>>,
    /// Bounds of the slopes of cladding functions, the lower below 1, the upper above. Default
    /// [0.5, 2].
    #[schemars(extend("default" = [0.5, 2.0]))]
    pub(crate) slope: Option<Field<Exactly<Plain<Slope>, 2>>>,
    /// Shortest side that splitting may make, a length. Default: no limit.
    pub(crate) min_side: Option<Field<Length<Extent>>>,
    /// Most patches that splitting may make, 1 to 2000. Default: no limit.
    pub(crate) max_patches: Option<Field<Count<1, 2000>>>,
    /// Longest side that splitting leaves patches with, a length: how large the designer wants them.
    /// Default: no limit.
    pub(crate) max_side: Option<Field<Length<Extent>>>,
}

section!(SplitSection {
    workflow,
    eta_max,
    slope,
    min_side,
    max_patches,
    max_side,
});

/// Supports of the structure.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct SupportsSection {
    /// Where: `"corners"` of the patches along the rim, `"every-boundary-crossing"` of the rim, or
    /// a list of points (`"a"`) and crossings (`"west.u03-v05"`). Default `"corners"`.
    #[schemars(extend("default" = "corners"))]
    pub(crate) at: Option<Field<SupportPlacesFile>>,
    /// What. Default `"printed"`.
    #[schemars(extend("default" = "printed"))]
    pub(crate) kind: Option<Field<Pick<SupportKind>>>,
    /// Height of the lowest contact face above the ground, a length. Default 0: as low as the
    /// supports can be with the grid clear of the ground.
    #[schemars(extend("default" = 0))]
    pub(crate) height: Option<Field<Length<Gap>>>,
}

section!(SupportsSection { at, kind, height });

/// Hardware at the crossings.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct HardwareSection {
    /// The bolt through each crossing, by its metric size. Default: by the narrowest lamella,
    /// `"M3"` below 15 mm, `"M4"` up to 30 mm, about a tenth of the width above.
    pub(crate) bolt: Option<Field<BoltName>>,
    /// Friction-reducing foil at every notch. Default: none.
    pub(crate) sticker: Option<Field<StickerFile>>,
    /// A tube around the bolt in the notch, by material, outer diameter and wall in
    /// millimetres: `"brass 5x0.5"`. Default: none.
    pub(crate) shell: Option<Field<TubeName>>,
}

section!(HardwareSection {
    bolt,
    sticker,
    shell
});

/// A foil sticker.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct StickerFile {
    /// Name of the foil. Default `"PTFE"`.
    #[schemars(extend("default" = "PTFE"))]
    pub(crate) foil: Option<Field<Label>>,
    /// Thickness of the foil, a length of at most 5 mm.
    pub(crate) thickness: Field<Length<FoilThickness>>,
    /// Margin around the contact area, a length. Default `"2 mm"`.
    #[schemars(extend("default" = "2 mm"))]
    pub(crate) margin: Option<Field<Length<Gap>>>,
    /// The sheet of foil that stickers are cut from. Default 600 mm x 300 mm.
    pub(crate) sheet: Option<Field<FoilFile>>,
}

section!(StickerFile {
    foil,
    thickness,
    margin,
    sheet
});

/// A sheet of foil.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct FoilFile {
    /// A length.
    pub(crate) length: Field<Length<Extent>>,
    /// A length.
    pub(crate) width: Field<Length<Extent>>,
}

section!(FoilFile { length, width });

/// Stock, machine and drawing conventions.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct FabricationSection {
    /// The panel that is bought, grain along its length. Default 2500 mm x 1250 mm.
    pub(crate) stock: Option<Field<StockFile>>,
    /// The machine's bed, where it limits a sheet. Default: the panel fits.
    pub(crate) bed: Option<Field<BedFile>>,
    /// Width that the cut removes, a length of at most 10 mm. Default 0, which draws nominal
    /// geometry for drivers that compensate by themselves.
    #[schemars(extend("default" = 0))]
    pub(crate) kerf: Option<Field<Length<KerfWidth>>>,
    /// Play of the bolt or shell in its opening, a length of at most 20 mm. Default `"0.2 mm"`.
    #[schemars(extend("default" = "0.2 mm"))]
    pub(crate) clearance: Option<Field<Length<Play>>>,
    /// Least distance between parts on a sheet, a length. Default `"3 mm"`.
    #[schemars(extend("default" = "3 mm"))]
    pub(crate) spacing: Option<Field<Length<Gap>>>,
    /// Border of the sheet that stays free, a length. Default `"10 mm"`.
    #[schemars(extend("default" = "10 mm"))]
    pub(crate) margin: Option<Field<Length<Gap>>>,
    /// From the centre of the last crossing to the end of a lamella, a length. Default: the
    /// width of the lamella.
    pub(crate) end_margin: Option<Field<Length<Extent>>>,
    /// Height of engraved labels, 0.5 to 500 mm. Default `"4 mm"`.
    #[schemars(extend("default" = "4 mm"))]
    pub(crate) label_height: Option<Field<Length<TextHeight>>>,
    /// Colours of cut files. Default `"red-cut"`.
    #[schemars(extend("default" = "red-cut"))]
    pub(crate) colours: Option<Field<Pick<ColourPreset>>>,
    /// How lamellae longer than the stock are joined. Default `"none"`.
    #[schemars(extend("default" = "none"))]
    pub(crate) splice: Option<Field<Pick<Splicing>>>,
}

section!(FabricationSection {
    stock,
    bed,
    kerf,
    clearance,
    spacing,
    margin,
    end_margin,
    label_height,
    colours,
    splice,
});

/// A panel.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct StockFile {
    /// Along the grain, a length.
    pub(crate) length: Field<Length<Extent>>,
    /// Across the grain, a length.
    pub(crate) width: Field<Length<Extent>>,
    /// Price of one panel, in any one currency for the whole project. Default: unknown.
    pub(crate) price: Option<Field<Plain<Money>>>,
}

section!(StockFile {
    length,
    width,
    price
});

/// A machine bed.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct BedFile {
    /// A length.
    pub(crate) length: Field<Length<Extent>>,
    /// A length.
    pub(crate) width: Field<Length<Extent>>,
    /// Whether a longer panel can be pushed through. Default false.
    #[schemars(extend("default" = false))]
    pub(crate) pass_through: Option<Field<bool>>,
}

section!(BedFile {
    length,
    width,
    pass_through
});

/// The mechanical simulation.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct SimulationSection {
    /// Gravity in m/s^2, three numbers of at most 1000. Default [0, 0, -9.81].
    #[schemars(extend("default" = [0.0, 0.0, -9.81]))]
    pub(crate) gravity: Option<Field<Exactly<Quantity<OfAcceleration, Pull>, 3>>>,
    /// Whether patches are coupled along their common lamellae. Default true.
    #[schemars(extend("default" = true))]
    pub(crate) connect_patches: Option<Field<bool>>,
}

section!(SimulationSection {
    gravity,
    connect_patches
});

/// A study: every size with every material.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct StudyFile {
    /// Factors of size, one number or 1 to 100, each 0.001 to 10000. Default 1.
    #[schemars(extend("default" = 1))]
    pub(crate) scale: Option<Field<OneOrMany<Plain<StudyFactor>, 100>>>,
    /// Names of materials, one or 1 to 100. Default: the project's own.
    pub(crate) materials: Option<Field<OneOrMany<Reference, 100>>>,
}

section!(StudyFile { scale, materials });

/// Lints.
#[derive(Debug, Clone, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct LintsSection {
    /// Names of lints that are not reported, such as `"thick-lamella"`. `egg explain NAME` tells
    /// what a lint is about. Default none.
    pub(crate) allow: Option<Field<List<Reference, 0, 100>>>,
}

section!(LintsSection { allow });

/// What to write where a required key is missing, with the blank or line break in front.
pub(crate) fn example(path: &KeyPath) -> Option<&'static str> {
    let name = path.as_str().rsplit('.').next().unwrap_or_default();
    let top = path.as_str() == name;
    let example = match name {
        "surface" if top => "\n[surface]\nmesh = \"pavilion.obj\"",
        "points" if top => "\n[points]\na = [0, 0]\nb = [800, 0]\nc = [800, 600]\nd = [0, 600]",
        "patches" if top => {
            "\n[patches.roof]\ncorners = [\"a\", \"b\", \"c\", \"d\"]\nmembers = { u = 7, v = 7 }"
        }
        "lamella" if top => {
            "\n[lamella]\nwidth = \"30 mm\"\nthickness = \"3 mm\"\nmaterial = \"poplar-plywood\""
        }
        "mesh" => " mesh = \"pavilion.obj\"",
        "corners" => " corners = [\"a\", \"b\", \"c\", \"d\"]",
        "material" => " material = \"poplar-plywood\" (`egg materials` lists the built-in ones)",
        "elastic_modulus" => " elastic_modulus = \"7.6 GPa\"",
        "shear_modulus" => " shear_modulus = \"0.5 GPa\"",
        "density" => " density = \"430 kg/m^3\"",
        "bending_strength" => " bending_strength = \"40 MPa\"",
        _ => return None,
    };
    Some(example)
}
