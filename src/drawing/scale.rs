//! A colour for a share from little to much: light yellow by orange to dark red-brown.
//!
//! The colours are those of ColorBrewer's scheme YlOrBr with nine classes (C. Brewer and
//! M. Harrower, colorbrewer2.org, Apache licence) but for the lightest two, which white paper
//! swallows, and the darkest, which a dark screen does. Between them runs a straight line in
//! sRGB. They are placed by their lightness in CIELAB, which so falls evenly: the order can be
//! seen in grey print, and with any kind of colour vision.

use super::Color;

/// Where the published colours stand.
const STOPS: [(f64, Color); 6] = [
    (0.0, Color::rgb(0xFE, 0xE3, 0x91)),
    (0.154, Color::rgb(0xFE, 0xC4, 0x4F)),
    (0.341, Color::rgb(0xFE, 0x99, 0x29)),
    (0.545, Color::rgb(0xEC, 0x70, 0x14)),
    (0.760, Color::rgb(0xCC, 0x4C, 0x02)),
    (1.0, Color::rgb(0x99, 0x34, 0x04)),
];

/// The colour of a share from 0, little, to 1, much; shares beyond are taken for the ends, and
/// what is no number for 0.
pub fn scale_color(share: f64) -> Color {
    let share = if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) };
    let after = STOPS.iter().position(|(place, _)| share <= *place).unwrap_or(STOPS.len() - 1);
    let [(from, a), (to, b)] = [STOPS[after.max(1) - 1], STOPS[after.max(1)]];
    let t = (share - from) / (to - from);
    let mix = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * t).round() as u8;
    Color::rgb(mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CIELAB of sRGB with the white of D65 (IEC 61966-2-1, CIE 15).
    fn lab(color: Color) -> [f64; 3] {
        let linear = [color.r, color.g, color.b].map(Color::linear_part);
        let row = |k: [f64; 3]| k.iter().zip(linear).map(|(k, x)| k * x).sum::<f64>();
        let f = |t: f64| {
            if t > 216.0 / 24389.0 { t.cbrt() } else { (24389.0 / 27.0 * t + 16.0) / 116.0 }
        };
        let x = f(row([0.412_456_4, 0.357_576_1, 0.180_437_5]) / 0.950_47);
        let y = f(row([0.212_672_9, 0.715_152_2, 0.072_175]));
        let z = f(row([0.019_333_9, 0.119_192, 0.950_304_1]) / 1.088_83);
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    #[test]
    fn lightness_falls_evenly_from_end_to_end() {
        let [light, dark] = [0.0, 1.0].map(|share| lab(scale_color(share))[0]);
        assert!(light < 92.0 && dark > 35.0 && light - dark > 50.0, "{light} to {dark}");
        for i in 0..=100 {
            let share = f64::from(i) / 100.0;
            let even = light + (dark - light) * share;
            let found = lab(scale_color(share))[0];
            assert!((found - even).abs() < 1.5, "{share}: {found}, not {even}");
        }
    }

    /// A difference of about 2 can just be seen side by side.
    #[test]
    fn tenths_are_told_apart() {
        let steps = (0..10).map(|i| {
            let [a, b] = [i, i + 1].map(|i| lab(scale_color(f64::from(i) / 10.0)));
            (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
        });
        let [least, most] = steps.fold([f64::INFINITY, 0.0], |[l, m], s| [s.min(l), s.max(m)]);
        assert!(least > 6.0 && most < 3.0 * least, "{least} to {most}");
    }

    #[test]
    fn published_colours_stand_in_their_places_and_ends_hold() {
        for (share, color) in STOPS {
            assert_eq!(scale_color(share), color);
        }
        assert_eq!(scale_color(-1.0), STOPS[0].1);
        assert_eq!(scale_color(7.0), STOPS[5].1);
        assert_eq!(scale_color(f64::NAN), STOPS[0].1);
    }
}
