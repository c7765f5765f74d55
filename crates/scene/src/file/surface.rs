//! What objects and mesh mirrors share: meshes, primitives, transforms.

use std::path::{Path, PathBuf};

use glam::{DMat3, DVec2, DVec3};

use super::Origin;
use crate::document::{SMALLEST, Table};
use crate::geometry::{Geometry, Transform, rotation};
use crate::obj::{self, Materials};
use crate::{SceneError, shapes};

/// Triangles to be made or read.
pub(super) enum Surface {
    Quad,
    Grid {
        cells: u32,
    },
    Cuboid {
        cells: u32,
    },
    Sphere {
        center: DVec3,
        radius: f64,
        segments: u32,
    },
    Torus {
        radius: f64,
        tube: f64,
        segments: u32,
    },
    Lathe {
        profile: Vec<DVec2>,
        cells: u32,
        segments: u32,
    },
    Teapot {
        cells: u32,
    },
    Mesh {
        file: String,
        mtl: Option<String>,
    },
}

/// Names of the primitives, for suggestions.
pub(super) const PRIMITIVES: [&str; 9] = [
    "quad", "grid", "box", "sphere", "torus", "lathe", "cylinder", "cone", "teapot",
];

/// Keys of a primitive; `None` where there is no such primitive.
pub(super) fn primitive(table: &Table<'_>, shape: &str) -> Result<Option<Surface>, SceneError> {
    let cells = || table.count("n", 1..=2048);
    let segments =
        |default| Ok::<_, SceneError>(table.count("segments", 3..=4096)?.unwrap_or(default));
    Ok(Some(match shape {
        "quad" => Surface::Quad,
        "grid" => Surface::Grid {
            cells: cells()?.unwrap_or(8),
        },
        "box" => Surface::Cuboid {
            cells: cells()?.unwrap_or(1),
        },
        "sphere" => Surface::Sphere {
            center: table.vector("center")?.unwrap_or(DVec3::ZERO),
            radius: table.positive("radius")?.unwrap_or(1.0),
            segments: table.count("segments", 4..=4096)?.unwrap_or(32),
        },
        "torus" => {
            let radius = table.positive("radius")?.unwrap_or(1.0);
            let tube = table.positive("tube")?.unwrap_or(0.35);
            if tube >= radius {
                return Err(table.error("tube", "must be smaller than `radius`"));
            }
            Surface::Torus {
                radius,
                tube,
                segments: segments(48)?,
            }
        }
        "lathe" => {
            let rows = table.rows::<2>("profile")?;
            let (cells, segments) = (cells()?.unwrap_or(1), segments(32)?);
            let rows = table.required("profile", rows)?;
            if rows.len() < 2 || rows.iter().any(|[distance, _]| *distance < 0.0) {
                let message = "must be at least 2 pairs of distance ≥ 0 from the axis and height";
                return Err(table.error("profile", message));
            }
            if rows
                .windows(2)
                .any(|pair| pair[0] == pair[1] || pair[0][0].max(pair[1][0]) == 0.0)
            {
                return Err(table.error("profile", "has a side without area"));
            }
            Surface::Lathe {
                profile: rows.into_iter().map(DVec2::from).collect(),
                cells,
                segments,
            }
        }
        "cylinder" | "cone" => {
            let top = if shape == "cone" {
                vec![(0.0, 1.0)]
            } else {
                vec![(1.0, 1.0), (0.0, 1.0)]
            };
            let profile = [(0.0, -1.0), (1.0, -1.0)]
                .into_iter()
                .chain(top)
                .map(DVec2::from)
                .collect();
            Surface::Lathe {
                profile,
                cells: cells()?.unwrap_or(1),
                segments: segments(32)?,
            }
        }
        "teapot" => Surface::Teapot {
            cells: table.count("n", 1..=128)?.unwrap_or(8),
        },
        _ => return Ok(None),
    }))
}

impl Surface {
    /// Reads or makes the triangles; `painted` where something replaces a mesh's materials.
    pub(super) fn geometry(
        &self,
        table: &Table<'_>,
        origin: &Origin<'_>,
        painted: bool,
    ) -> Result<Geometry, SceneError> {
        Ok(match self {
            Self::Quad => shapes::grid(1),
            Self::Grid { cells } => shapes::grid(*cells),
            Self::Cuboid { cells } => shapes::cuboid(*cells),
            Self::Sphere {
                center,
                radius,
                segments,
            } => shapes::sphere(*center, *radius, *segments),
            Self::Torus {
                radius,
                tube,
                segments,
            } => shapes::torus(*radius, *tube, *segments),
            Self::Lathe {
                profile,
                cells,
                segments,
            } => shapes::lathe(profile, *cells, *segments),
            Self::Teapot { cells } => shapes::teapot(*cells),
            Self::Mesh { file, mtl } => {
                let path = find(table, file, origin)?;
                let materials = match mtl {
                    _ if painted => Materials::Ignored,
                    None => Materials::Own,
                    Some(mtl) => {
                        let other = path.parent().unwrap_or(Path::new("")).join(mtl);
                        if !other.is_file() {
                            let message = format_args!("names no file: {}", other.display());
                            return Err(table.error("mtl", message));
                        }
                        Materials::Other(other)
                    }
                };
                obj::read(&path, &materials)?
            }
        })
    }
}

/// A mesh file: beside the scene file, else in the models folder or its subfolder of that name.
fn find(table: &Table<'_>, model: &str, origin: &Origin<'_>) -> Result<PathBuf, SceneError> {
    let stem = Path::new(model).file_stem().unwrap_or_default();
    let models = origin.options.models.as_ref();
    let candidates = origin.folder.iter().map(|folder| folder.join(model)).chain(
        models
            .iter()
            .flat_map(|folder| [folder.join(model), folder.join(stem).join(model)]),
    );
    if let Some(path) = candidates.into_iter().find(|path| path.is_file()) {
        return Ok(path);
    }
    let models = match models {
        Some(folder) => format!("in the models folder {}", folder.display()),
        None => "in a models folder: none is given".to_owned(),
    };
    Err(SceneError::MissingModel {
        file: table.file().to_owned(),
        line: table.line("mesh"),
        owner: table.owner().to_owned(),
        model: model.to_owned(),
        searched: match origin.folder {
            Some(_) => format!("beside the scene file or {models}"),
            None => models,
        },
    })
}

/// `transform = { scale, rotate_deg, translate }`.
pub(super) fn transform(table: &Table<'_>) -> Result<Transform, SceneError> {
    let Some(table) = table.table("transform")? else {
        return Ok(Transform::IDENTITY);
    };
    let scale = table.scale("scale")?.unwrap_or(DVec3::ONE);
    let degrees = table.vector("rotate_deg")?.unwrap_or(DVec3::ZERO);
    let translate = table.vector("translate")?.unwrap_or(DVec3::ZERO);
    table.finish()?;
    if scale.abs().min_element() < SMALLEST {
        return Err(table.error("scale", "must not be zero: the transform cannot be undone"));
    }
    Ok(Transform {
        linear: rotation(degrees) * DMat3::from_diagonal(scale),
        translate,
    })
}
