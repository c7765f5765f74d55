//! Whether a scene is complete enough to be traced: a loaded scene always is, one built by hand may
//! not be.

use catoptric_scene::Mesh;

use crate::error::ReferenceError;

/// Whether a mesh can be traced.
pub(crate) fn check(surface: &str, mesh: &Mesh) -> Result<(), ReferenceError> {
    if let Some(index) = mesh
        .positions
        .iter()
        .position(|position| !position.is_finite())
    {
        return Err(ReferenceError::NotFinite {
            surface: surface.to_owned(),
            index,
        });
    }
    for (triangle, corners) in mesh.triangles.iter().enumerate() {
        for index in *corners {
            check_index(surface, triangle, "position", index, mesh.positions.len())?;
        }
    }
    for (what, found) in [
        ("normals", mesh.normals.len()),
        ("texture coordinates", mesh.uvs.len()),
    ] {
        if found != 0 {
            check_count(surface, what, found, mesh.triangles.len())?;
        }
    }
    Ok(())
}

/// Whether each of its triangles has a paint.
pub(crate) fn check_paint(surface: &str, mesh: &Mesh) -> Result<(), ReferenceError> {
    let triangles = mesh.triangles.len();
    check_count(surface, "materials", mesh.material.len(), triangles)?;
    for (triangle, index) in mesh.material.iter().enumerate() {
        check_index(surface, triangle, "material", *index, mesh.materials.len())?;
    }
    let by_vertex = |material: &catoptric_scene::Material| {
        matches!(material.paint, catoptric_scene::Paint::Vertex)
    };
    if mesh.materials.iter().any(by_vertex) {
        check_count(surface, "corner colours", mesh.colors.len(), triangles)?;
    }
    Ok(())
}

/// Whether there is one of something for each triangle.
pub(crate) fn check_count(
    surface: &str,
    what: &'static str,
    found: usize,
    triangles: usize,
) -> Result<(), ReferenceError> {
    if found == triangles {
        return Ok(());
    }
    Err(ReferenceError::Attribute {
        surface: surface.to_owned(),
        what,
        found,
        triangles,
    })
}

fn check_index(
    surface: &str,
    triangle: usize,
    what: &'static str,
    index: u32,
    count: usize,
) -> Result<(), ReferenceError> {
    if (index as usize) < count {
        return Ok(());
    }
    Err(ReferenceError::Index {
        surface: surface.to_owned(),
        triangle,
        what,
        index,
        count,
    })
}
