#include "core/emitter/sun_radiance.h"

#include "core/sampling/warp.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// W·m⁻²·sr⁻¹·nm⁻¹ above the atmosphere, every 10 nm from 380 nm.
constexpr double above_the_atmosphere[] = {16559.0, 16233.7, 21127.5, 25888.2, 25829.1, 24232.3, 26760.5, 29658.3, 30545.4, 30057.5,
                                           30663.7, 28830.4, 28712.1, 27825.0, 27100.6, 27233.6, 26361.3, 25503.8, 25060.2, 25311.6,
                                           25355.9, 25134.2, 24631.5, 24173.2, 23685.3, 23212.1, 22827.7, 22339.8, 21970.2, 21526.7,
                                           21097.9, 20728.3, 20240.4, 19870.8, 19427.2, 19072.4, 18628.9, 18259.2};

// The absorption is linear between wavelengths.
struct Line {
    double wavelength, k;
};
constexpr Line ozone[] = {  // cm⁻¹; the part that is visible
    {355, 0},     {445, 0.003}, {450, 0.003}, {455, 0.004}, {460, 0.006}, {465, 0.008}, {470, 0.009}, {475, 0.012}, {480, 0.014},
    {485, 0.017}, {490, 0.021}, {495, 0.025}, {500, 0.03},  {505, 0.035}, {510, 0.04},  {515, 0.045}, {520, 0.048}, {525, 0.057},
    {530, 0.063}, {535, 0.07},  {540, 0.075}, {545, 0.08},  {550, 0.085}, {555, 0.095}, {560, 0.103}, {565, 0.11},  {570, 0.12},
    {575, 0.122}, {580, 0.12},  {585, 0.118}, {590, 0.115}, {595, 0.12},  {600, 0.125}, {605, 0.13},  {610, 0.12},  {620, 0.105},
    {630, 0.09},  {640, 0.079}, {650, 0.067}, {660, 0.057}, {670, 0.048}, {680, 0.036}, {690, 0.028}, {700, 0.023}, {710, 0.018},
    {720, 0.014}, {730, 0.011}, {740, 0.01},  {750, 0.009}};
constexpr Line water_vapour[] = {{689, 0}, {690, 0.016}, {700, 0.024}, {710, 0.0125},
                                 {720, 1}, {730, 0.87},  {740, 0.061}, {750, 0.001}};

template <std::size_t size>
double absorption(const Line (&lines)[size], double wavelength) {
    const Line* next = std::find_if(lines, lines + size, [&](const Line& line) { return line.wavelength >= wavelength; });
    if (next == lines) return 0.0;
    const Line &a = next[-1], &b = *next;
    return a.k + (b.k - a.k) * (wavelength - a.wavelength) / (b.wavelength - a.wavelength);
}

}  // namespace

SpectrumTable sun_spectrum(double turbidity, double elevation) {
    const double beta = 0.04608365822050 * turbidity - 0.04586025928522;
    const double zenith_angle = 90.0 - elevation * 180.0 / pi;
    // The relative optical mass of the air (Kasten).
    const double m = 1.0 / (std::sin(elevation) + 0.15 * std::pow(93.885 - zenith_angle, -1.253));
    constexpr double ozone_depth = 0.35, water_depth = 2.0;  // cm

    SpectrumTable spectrum;
    // The spectrum is sampled every 5 nm, as the tables of the colour-matching functions are. Mixed gases absorb above 759 nm only.
    for (int i = 0; i <= 74; ++i) {
        const double wavelength = 380.0 + 5.0 * i, micrometres = wavelength / 1000.0;
        const double light = 0.5 * (above_the_atmosphere[i / 2] + above_the_atmosphere[(i + 1) / 2]);
        const double vapour = absorption(water_vapour, wavelength) * water_depth * m;
        const double depth = m * (0.008735 * std::pow(micrometres, -4.08) + beta * std::pow(micrometres, -1.3) +
                                  absorption(ozone, wavelength) * ozone_depth) +
                             0.2385 * vapour / std::pow(1.0 + 20.07 * vapour, 0.45);
        spectrum.wavelengths.push_back(wavelength);
        spectrum.values.push_back(light * std::exp(-depth));
    }
    return spectrum;
}

}  // namespace neumann
