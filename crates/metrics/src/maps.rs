//! Error maps: where a picture differs, and how that is painted.

use catoptric_frame::{Frame, Image, Status};

use crate::MetricsError;
use crate::coverage::Layers;
use crate::flip::{DEFAULT_PIXELS_PER_DEGREE, flip};

/// What an error map shows. NaN wherever the quantity does not exist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapKind {
    /// Mean over the channels of `|test − reference|`, mirror pixels.
    AbsColor,
    /// Mean over the channels of `test − reference`, mirror pixels.
    SignedColor,
    /// Angular error in degrees, mirror pixels where both see the same object.
    Angular,
    /// 1 where the ids differ, 0 where they agree, mirror pixels.
    IdMismatch,
    /// The code of a [`CoverageClass`], mirror pixels.
    Coverage,
    /// FLIP-LDR, mirror pixels.
    Flip,
}

/// What a coverage map distinguishes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum CoverageClass {
    /// Both see the same.
    Agree = 0,
    /// The reference sees an object, the technique the background.
    Missing = 1,
    /// The technique sees an object, the reference the background.
    Extra = 2,
    /// Two different objects.
    WrongId = 3,
    /// Missing, in a crack.
    Crack = 4,
    /// The technique has no answer.
    Unresolved = 5,
}

/// Colours for a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colormap {
    /// Black through purple to light yellow: magnitudes.
    Magma,
    /// Blue through grey to red: signed values, with the middle of the range neutral.
    CoolWarm,
}

impl CoverageClass {
    /// All classes in the order of their codes, for legends.
    pub const ALL: [Self; 6] = [
        Self::Agree,
        Self::Missing,
        Self::Extra,
        Self::WrongId,
        Self::Crack,
        Self::Unresolved,
    ];

    /// What a legend says.
    pub fn label(self) -> &'static str {
        match self {
            Self::Agree => "agrees",
            Self::Missing => "missing",
            Self::Extra => "extra",
            Self::WrongId => "wrong object",
            Self::Crack => "crack",
            Self::Unresolved => "unresolved",
        }
    }

    /// sRGB. After Okabe and Ito's palette, which colour-blind readers can tell apart.
    pub fn color(self) -> [u8; 3] {
        match self {
            Self::Agree => [238, 238, 238],
            Self::Missing => [213, 94, 0],
            Self::Extra => [0, 114, 178],
            Self::WrongId => [204, 121, 167],
            Self::Crack => [0, 0, 0],
            Self::Unresolved => [240, 228, 66],
        }
    }
}

/// What lies outside the mask.
pub const MASKED_COLOR: [u8; 3] = [128, 128, 128];

/// The map of one quantity, NaN outside the mirror pixels that both see.
pub fn error_map(
    kind: MapKind,
    reference: &Frame,
    test: &Frame,
) -> Result<Image<f32>, MetricsError> {
    let layers = Layers::new(reference, test)?;
    let difference = |index: usize| {
        let [test, reference] = [test, reference].map(|frame| frame.color.pixels()[index]);
        test.as_dvec3() - reference.as_dvec3()
    };
    let of_mask = |value: &dyn Fn(usize) -> f32| {
        let mut map = Image::filled(layers.size, f32::NAN);
        for index in layers.mirror_pixels() {
            map.pixels_mut()[index] = value(index);
        }
        map
    };
    Ok(match kind {
        MapKind::AbsColor => of_mask(&|index| (difference(index).abs().element_sum() / 3.0) as f32),
        MapKind::SignedColor => of_mask(&|index| (difference(index).element_sum() / 3.0) as f32),
        MapKind::Angular => of_mask(&|index| {
            layers
                .angular_error_deg(index)
                .map_or(f32::NAN, |degrees| degrees as f32)
        }),
        MapKind::IdMismatch => of_mask(&|index| f32::from(u8::from(!layers.agree(index)))),
        MapKind::Coverage => {
            let in_crack = layers.gaps().in_crack;
            of_mask(&|index| {
                f32::from(coverage_class(&layers, index, in_crack.pixels()[index]) as u8)
            })
        }
        MapKind::Flip => {
            let flip = flip(&reference.color, &test.color, DEFAULT_PIXELS_PER_DEGREE)?;
            of_mask(&|index| flip.pixels()[index])
        }
    })
}

fn coverage_class(layers: &Layers, index: usize, in_crack: bool) -> CoverageClass {
    if layers.agree(index) {
        return CoverageClass::Agree;
    }
    if in_crack {
        return CoverageClass::Crack;
    }
    if layers.test.status.pixels()[index] == Status::Unresolved {
        return CoverageClass::Unresolved;
    }
    match layers.show(index) {
        [true, false] => CoverageClass::Missing,
        [false, true] => CoverageClass::Extra,
        [true, true] => CoverageClass::WrongId,
        // The reference is unresolved where the technique sees the background.
        [false, false] => CoverageClass::Unresolved,
    }
}

/// Paints a map: `range[0]` and below gets the first colour, `range[1]` and above the last, NaN
/// [`MASKED_COLOR`]. With an empty range everything gets the colour of no error.
pub fn colorize(map: &Image<f32>, range: [f32; 2], colormap: Colormap) -> Image<[u8; 3]> {
    let [low, high] = range;
    map.map(|&value| {
        if value.is_nan() {
            MASKED_COLOR
        } else if high > low {
            colormap.color((value.clamp(low, high) - low) / (high - low))
        } else {
            colormap.color(colormap.no_error())
        }
    })
}

/// Paints a map of [`MapKind::Coverage`] in the colours of its classes.
pub fn colorize_coverage(map: &Image<f32>) -> Image<[u8; 3]> {
    map.map(|&code| {
        let class = CoverageClass::ALL
            .into_iter()
            .find(|&class| f32::from(class as u8) == code);
        class.map_or(MASKED_COLOR, CoverageClass::color)
    })
}

/// A horizontal strip of the colour map, low values left, with `ticks` evenly spaced tick marks
/// from end to end along its lower edge.
pub fn color_bar(colormap: Colormap, size: [u32; 2], ticks: u32) -> Image<[u8; 3]> {
    let [width, height] = size;
    let last = width.saturating_sub(1);
    let tick_height = (height / 4).max(1);
    let mut bar = Image::filled(size, MASKED_COLOR);
    for y in 0..height {
        for x in 0..width {
            *bar.at_mut(x, y) = colormap.color(x as f32 / last.max(1) as f32);
        }
    }
    for tick in 0..ticks.min(width) {
        let place = u64::from(tick) * u64::from(last) / u64::from(ticks.saturating_sub(1).max(1));
        for y in height.saturating_sub(tick_height)..height {
            let pixel = bar.at_mut(place as u32, y);
            // Dark on light and light on dark.
            let light = pixel.iter().map(|&channel| u32::from(channel)).sum::<u32>() > 382;
            *pixel = if light { [0; 3] } else { [255; 3] };
        }
    }
    bar
}

impl Colormap {
    /// Steps of a colour map, which has one colour more than this. A picture with these colours and the
    /// greys of another picture still fits a palette of 256, which halves the size of its file.
    const STEPS: f32 = 128.0;

    /// sRGB colour at `t` from 0 to 1, in steps of 1/128, interpolated between evenly spaced stops.
    pub fn color(self, t: f32) -> [u8; 3] {
        let stops = self.stops();
        let t = (t.clamp(0.0, 1.0) * Self::STEPS).round() / Self::STEPS;
        let place = t * (stops.len() - 1) as f32;
        let below = (place as usize).min(stops.len() - 2);
        let share = place - below as f32;
        std::array::from_fn(|channel| {
            let [low, high] = [below, below + 1].map(|stop| f32::from(stops[stop][channel]));
            (low + (high - low) * share).round() as u8
        })
    }

    /// Where on the colour map 0 lies.
    fn no_error(self) -> f32 {
        match self {
            Self::Magma => 0.0,
            Self::CoolWarm => 0.5,
        }
    }

    fn stops(self) -> &'static [[u8; 3]] {
        match self {
            Self::Magma => &[
                [0, 0, 4],
                [24, 15, 61],
                [68, 15, 118],
                [114, 31, 129],
                [158, 47, 127],
                [205, 64, 113],
                [241, 96, 93],
                [253, 150, 104],
                [254, 202, 141],
                [252, 253, 191],
            ],
            Self::CoolWarm => &[
                [59, 76, 192],
                [98, 130, 234],
                [141, 176, 254],
                [184, 208, 249],
                [221, 221, 221],
                [245, 196, 173],
                [244, 154, 123],
                [222, 96, 77],
                [180, 4, 38],
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colour_maps_hit_their_ends_and_middle() {
        assert_eq!(Colormap::Magma.color(0.0), [0, 0, 4]);
        assert_eq!(Colormap::Magma.color(1.0), [252, 253, 191]);
        assert_eq!(Colormap::CoolWarm.color(0.5), [221, 221, 221]);
        assert_eq!(Colormap::CoolWarm.color(7.0), [180, 4, 38]);
    }

    #[test]
    fn painting_clamps_and_greys_out() {
        let map = Image::from_vec([4, 1], vec![f32::NAN, -1.0, f32::INFINITY, 0.0]);
        let painted = colorize(&map, [-2.0, 2.0], Colormap::CoolWarm);
        assert_eq!(painted.pixels()[0], MASKED_COLOR);
        assert_eq!(painted.pixels()[1], [141, 176, 254]);
        assert_eq!(painted.pixels()[2], [180, 4, 38]);
        assert_eq!(painted.pixels()[3], [221, 221, 221]);
        assert_eq!(
            colorize(&map, [0.0, 0.0], Colormap::Magma).pixels()[3],
            [0, 0, 4]
        );
    }

    #[test]
    fn the_bar_has_its_ticks_at_both_ends_and_between() {
        let bar = color_bar(Colormap::Magma, [101, 8], 3);
        let ticked: Vec<u32> = (0..101).filter(|&x| bar.at(x, 7) != bar.at(x, 0)).collect();
        assert_eq!(ticked, [0, 50, 100]);
        assert_eq!(*bar.at(100, 7), [0; 3]);
        color_bar(Colormap::Magma, [1, 1], 5);
        color_bar(Colormap::Magma, [0, 0], 0);
    }

    #[test]
    fn coverage_codes_have_their_own_colours() {
        let codes: Vec<f32> = (0..7).map(|code| code as f32).collect();
        let painted = colorize_coverage(&Image::from_vec([7, 1], codes));
        for (class, pixel) in CoverageClass::ALL.into_iter().zip(painted.pixels()) {
            assert_eq!(*pixel, class.color(), "{}", class.label());
        }
        assert_eq!(painted.pixels()[6], MASKED_COLOR);
    }
}
