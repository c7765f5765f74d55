//! The id → name list, as text in an EXR header and as the source of a derived status.

use std::collections::BTreeSet;

use crate::{Frame, Image, Name, Primary, Reflected, Status};

/// One line an id: `1 object floor`.
pub(crate) fn to_text(names: &[Name]) -> Result<String, String> {
    let mut text = String::new();
    for Name { id, name, mirror } in names {
        if name.contains(['\n', '\r']) {
            return Err(format!("the name of id {id} contains a line break"));
        }
        let kind = if *mirror { "mirror" } else { "object" };
        text += &format!("{id} {kind} {name}\n");
    }
    Ok(text)
}

/// The inverse of [`to_text`]. Blank lines are skipped; ids come back ascending.
pub(crate) fn from_text(text: &str) -> Result<Vec<Name>, String> {
    let mut names = text
        .lines()
        .filter(|line| !line.trim().is_empty())
        .map(|line| parse_line(line).ok_or_else(|| format!("`{line}` is not `ID KIND NAME`")))
        .collect::<Result<Vec<_>, _>>()?;
    names.sort_by_key(|name| name.id);
    match names.windows(2).find(|pair| pair[0].id == pair[1].id) {
        Some(pair) => Err(format!("id {} is listed twice", pair[0].id)),
        None => Ok(names),
    }
}

fn parse_line(line: &str) -> Option<Name> {
    let (id, rest) = line.split_once(' ')?;
    let (kind, name) = rest.split_once(' ')?;
    let mirror = match kind {
        "mirror" => true,
        "object" => false,
        _ => return None,
    };
    let id = id.parse().ok().filter(|&id| id > 0)?;
    Some(Name {
        id,
        name: name.to_owned(),
        mirror,
    })
}

/// The status of a picture without a status layer: a mirror's pixel is resolved, everything else is
/// no mirror. The names say which ids are mirrors; without names, the mirrors are the ids that have
/// a reflected id at some pixel. Without the ids of the first surfaces, a pixel with a reflected id
/// is resolved.
pub(crate) fn derived_status(
    names: &[Name],
    primary: Option<&Primary>,
    reflected_id: &Image<u32>,
) -> Image<Status> {
    let status = |mirror: bool| {
        if mirror {
            Status::Resolved
        } else {
            Status::NotMirror
        }
    };
    let Some(Primary { id, .. }) = primary else {
        return reflected_id.map(|&id| status(id > 0));
    };
    let mirrors: BTreeSet<u32> = if names.is_empty() {
        let pixels = id.pixels().iter().zip(reflected_id.pixels());
        let reflecting = pixels.filter(|&(&id, &reflected)| id > 0 && reflected > 0);
        reflecting.map(|(&id, _)| id).collect()
    } else {
        let mirrors = names.iter().filter(|name| name.mirror);
        mirrors.map(|name| name.id).collect()
    };
    id.map(|id| status(mirrors.contains(id)))
}

impl Frame {
    /// Gives the ids their names, for pictures from elsewhere that do not bring them, and
    /// re-derives from them which pixels are mirror pixels. What a mirror pixel already says about
    /// itself (unresolved, below, back) is kept.
    pub fn assign_names(&mut self, names: Vec<Name>) {
        if let Some(Reflected { status, id, .. }) = &mut self.reflected {
            let derived = derived_status(&names, self.primary.as_ref(), id);
            for (status, &derived) in status.pixels_mut().iter_mut().zip(derived.pixels()) {
                if derived == Status::NotMirror || *status == Status::NotMirror {
                    *status = derived;
                }
            }
        }
        self.names = names;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_round_trip_keeps_spaces_and_other_scripts() {
        let names = vec![
            Name {
                id: 1,
                name: "large floor".into(),
                mirror: false,
            },
            Name {
                id: 2,
                name: "зеркало".into(),
                mirror: true,
            },
            Name {
                id: 3,
                name: String::new(),
                mirror: false,
            },
        ];
        assert_eq!(from_text(&to_text(&names).unwrap()).unwrap(), names);
    }

    #[test]
    fn odd_lists_are_refused() {
        for text in [
            "floor",
            "0 object floor",
            "1 thing floor",
            "1 object a\n1 mirror b",
        ] {
            assert!(from_text(text).is_err(), "{text}");
        }
        let name = Name {
            id: 1,
            name: "a\nb".into(),
            mirror: false,
        };
        assert!(to_text(&[name]).is_err());
    }
}
