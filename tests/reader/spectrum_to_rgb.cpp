// Spectra as colours, against the CIE's figures and the colours that Mitsuba's Cornell box gives for its own spectra.
#include "core/image/colour/spectrum_to_rgb.h"

#include "core/image/colour/blackbody.h"
#include "core/image/colour/cie.h"

#include <gtest/gtest.h>

namespace neumann::spectrum_to_rgb_test {

SpectrumTable constant(double value, double from = 360.0, double to = 830.0) { return {{from, to}, {value, value}}; }

void expect_near(const Rgb& a, const Rgb& b, double tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "channel " << i;
}

// Mitsuba's Cornell box, fragments/bsdfs-spectral.xml: 400 to 700 nm by 4 nm.
SpectrumTable every_4_nm(const std::vector<double>& values) {
    SpectrumTable s;
    for (std::size_t i = 0; i < values.size(); ++i) s.wavelengths.push_back(400.0 + 4.0 * static_cast<double>(i));
    s.values = values;
    return s;
}

SpectrumTable white() {
    return every_4_nm({0.343, 0.445, 0.551, 0.624, 0.665, 0.687, 0.708, 0.723, 0.715, 0.71,  0.745, 0.758, 0.739,
                       0.767, 0.777, 0.765, 0.751, 0.745, 0.748, 0.729, 0.745, 0.757, 0.753, 0.75,  0.746, 0.747,
                       0.735, 0.732, 0.739, 0.734, 0.725, 0.721, 0.733, 0.725, 0.732, 0.743, 0.744, 0.748, 0.728,
                       0.716, 0.733, 0.726, 0.713, 0.74,  0.754, 0.764, 0.752, 0.736, 0.734, 0.741, 0.74,  0.732,
                       0.745, 0.755, 0.751, 0.744, 0.731, 0.733, 0.744, 0.731, 0.712, 0.708, 0.729, 0.73,  0.727,
                       0.707, 0.703, 0.729, 0.75,  0.76,  0.751, 0.739, 0.724, 0.73,  0.74,  0.737});
}

SpectrumTable red() {
    return every_4_nm({0.04,  0.046, 0.048, 0.053, 0.049, 0.05,  0.053, 0.055, 0.057, 0.056, 0.059, 0.057, 0.061,
                       0.061, 0.06,  0.062, 0.062, 0.062, 0.061, 0.062, 0.06,  0.059, 0.057, 0.058, 0.058, 0.058,
                       0.056, 0.055, 0.056, 0.059, 0.057, 0.055, 0.059, 0.059, 0.058, 0.059, 0.061, 0.061, 0.063,
                       0.063, 0.067, 0.068, 0.072, 0.08,  0.09,  0.099, 0.124, 0.154, 0.192, 0.255, 0.287, 0.349,
                       0.402, 0.443, 0.487, 0.513, 0.558, 0.584, 0.62,  0.606, 0.609, 0.651, 0.612, 0.61,  0.65,
                       0.638, 0.627, 0.62,  0.63,  0.628, 0.642, 0.639, 0.657, 0.639, 0.635, 0.642});
}

SpectrumTable green() {
    return every_4_nm({0.092, 0.096, 0.098, 0.097, 0.098, 0.095, 0.095, 0.097, 0.095, 0.094, 0.097, 0.098, 0.096,
                       0.101, 0.103, 0.104, 0.107, 0.109, 0.112, 0.115, 0.125, 0.14,  0.16,  0.187, 0.229, 0.285,
                       0.343, 0.39,  0.435, 0.464, 0.472, 0.476, 0.481, 0.462, 0.447, 0.441, 0.426, 0.406, 0.373,
                       0.347, 0.337, 0.314, 0.285, 0.277, 0.266, 0.25,  0.23,  0.207, 0.186, 0.171, 0.16,  0.148,
                       0.141, 0.136, 0.13,  0.126, 0.123, 0.121, 0.122, 0.119, 0.114, 0.115, 0.117, 0.117, 0.118,
                       0.12,  0.122, 0.128, 0.132, 0.139, 0.144, 0.146, 0.15,  0.152, 0.157, 0.159});
}

TEST(SpectrumTables, SumsOfTheObserver) {
    Vec3 sum(0.0);
    for (const auto& row : cie::observer_1931) sum += Vec3(row[0], row[1], row[2]) * cie::step;
    EXPECT_NEAR(sum.x, 106.8657, 1e-4);
    EXPECT_NEAR(sum.y, 106.8570, 1e-4);
    EXPECT_NEAR(sum.z, 106.8933, 1e-4);
}

TEST(SpectrumTables, WhitePointOfD65) {
    // The CIE's chromaticity of D65 is 0.31272, 0.32903.
    Vec3 xyz(0.0);
    for (int i = 0; i < cie::count; ++i)
        for (int k = 0; k < 3; ++k) xyz[k] += cie::observer_1931[i][k] * cie::illuminant_d65[i];
    EXPECT_NEAR(xyz.x / (xyz.x + xyz.y + xyz.z), 0.31272, 3e-5);
    EXPECT_NEAR(xyz.y / (xyz.x + xyz.y + xyz.z), 0.32903, 3e-5);
    EXPECT_EQ(cie::illuminant_d65[40], 100.0);  // 560 nm
}

TEST(SpectrumToRgb, WhiteReflectanceIsWhite) { expect_near(spectrum_to_rgb(constant(1.0), Illuminant::d65), Rgb(1.0), 2e-4); }

TEST(SpectrumToRgb, EqualEnergyIsNotTheWhiteOfSrgb) {
    // X = Y = Z = 1 up to the tables' rounding, so the rows of the matrix summed.
    expect_near(spectrum_to_rgb(constant(1.0), Illuminant::equal_energy), {1.204794, 0.948291, 0.908916}, 5e-4);
}

TEST(SpectrumToRgb, Linear) {
    expect_near(spectrum_to_rgb(constant(1e30), Illuminant::d65) / 1e30, spectrum_to_rgb(constant(1.0), Illuminant::d65), 1e-12);
    const SpectrumTable left = {{360.0, 550.0}, {1.0, 1.0}}, right = {{550.0, 830.0}, {1.0, 1.0}};
    expect_near(spectrum_to_rgb(left, Illuminant::d65) + spectrum_to_rgb(right, Illuminant::d65),
                spectrum_to_rgb(constant(1.0), Illuminant::d65), 1e-12);
}

TEST(SpectrumToRgb, ZeroOutsideItsRange) {
    expect_near(spectrum_to_rgb(constant(1.0, 850.0, 900.0), Illuminant::equal_energy), Rgb(0.0), 0.0);
    expect_near(spectrum_to_rgb(constant(1.0, 200.0, 2000.0), Illuminant::d65), spectrum_to_rgb(constant(1.0), Illuminant::d65),
                1e-12);
    // Wavelengths between the tables' knots count as they are.
    const Rgb part = spectrum_to_rgb(constant(1.0, 551.0, 553.0), Illuminant::equal_energy);
    EXPECT_NEAR(0.2126 * part.r + 0.7152 * part.g + 0.0722 * part.b, 2.0 * 0.99697 / 106.857, 1e-5);
}

// fragments/bsdfs-rgb.xml was made from these spectra under equal energy, to three digits.
TEST(SpectrumToRgb, CornellBoxUnderEqualEnergy) {
    expect_near(spectrum_to_rgb(white(), Illuminant::equal_energy), {0.885809, 0.698859, 0.666422}, 6e-4);
    expect_near(spectrum_to_rgb(red(), Illuminant::equal_energy), {0.570068, 0.0430135, 0.0443706}, 6e-4);
    expect_near(spectrum_to_rgb(green(), Illuminant::equal_energy), {0.105421, 0.37798, 0.076425}, 6e-4);
    expect_near(spectrum_to_rgb(constant(0.78, 400.0, 700.0), Illuminant::equal_energy), {0.936461, 0.740433, 0.705267}, 8e-4);
}

// As reflectances they are what they look like: the white paint is nearly neutral.
TEST(SpectrumToRgb, CornellBoxAsReflectance) {
    expect_near(spectrum_to_rgb(white(), Illuminant::d65), {0.735851, 0.736432, 0.737123}, 1e-5);
    expect_near(spectrum_to_rgb(red(), Illuminant::d65), {0.491878, 0.049281, 0.050983}, 1e-5);
    expect_near(spectrum_to_rgb(green(), Illuminant::d65), {0.068364, 0.398199, 0.086398}, 1e-5);
}

// An independent sum over 9400 steps; the scene cbox-rgb.xml has 18.387, 10.9873, 2.75357 for this lamp.
TEST(SpectrumToRgb, CornellBoxLamp) {
    const SpectrumTable lamp = {{400.0, 500.0, 600.0, 700.0}, {0.0, 8.0, 15.6, 18.4}};
    expect_near(spectrum_to_rgb(lamp, Illuminant::equal_energy), {20.7113, 10.85459, 2.771149}, 1e-4);
}

TEST(BlackBody, LawsOfStefanAndBoltzmannAndOfWien) {
    for (const double temperature : {2000.0, 5000.0}) {
        double sum = 0.0, largest = 0.0, at = 0.0;
        for (double w = 50.0; w < 200'000.0; w += 1.0) {
            const double radiance = blackbody_radiance(w, temperature);
            sum += radiance;
            if (radiance > largest) largest = radiance, at = w;
        }
        EXPECT_NEAR(3.14159265358979 * sum / (5.670374419e-8 * std::pow(temperature, 4.0)), 1.0, 1e-5);
        EXPECT_NEAR(at, 2.897771955e6 / temperature, 1.0);
    }
}

// Chromaticities of black bodies as published for the CIE 1931 observer (Wyszecki and Stiles, Color Science, 1982), and of the
// CIE's illuminant A, which is one of 2855.5 K.
TEST(BlackBody, Chromaticities) {
    struct Published {
        double temperature, x, y;
    };
    for (const auto& [temperature, x, y] : {Published{2000.0, 0.5267, 0.4133}, Published{2855.5, 0.44758, 0.40745},
                                            Published{4000.0, 0.3805, 0.3768}, Published{10000.0, 0.2807, 0.2884}}) {
        SpectrumTable s;
        for (int w = 360; w <= 830; ++w) {
            s.wavelengths.push_back(w);
            s.values.push_back(blackbody_radiance(w, temperature));
        }
        const Rgb c = spectrum_to_rgb(s, Illuminant::equal_energy);
        // ITU-R BT.709's way back.
        const Vec3 xyz(0.412453 * c.r + 0.357580 * c.g + 0.180423 * c.b, 0.212671 * c.r + 0.715160 * c.g + 0.072169 * c.b,
                       0.019334 * c.r + 0.119193 * c.g + 0.950227 * c.b);
        EXPECT_NEAR(xyz.x / (xyz.x + xyz.y + xyz.z), x, 2e-4) << temperature << " K";
        EXPECT_NEAR(xyz.y / (xyz.x + xyz.y + xyz.z), y, 2e-4) << temperature << " K";
    }
}

TEST(Srgb, Decode) {
    EXPECT_EQ(srgb_decode(0.0), 0.0);
    EXPECT_DOUBLE_EQ(srgb_decode(1.0), 1.0);
    EXPECT_NEAR(srgb_decode(0.5), 0.21404114, 1e-8);
    EXPECT_NEAR(srgb_decode(0.04045), 0.0031308, 1e-7);
}

}  // namespace neumann::spectrum_to_rgb_test
