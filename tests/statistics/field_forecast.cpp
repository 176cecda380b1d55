// What renders from fields foretell of the next one: errors of which the parts are known, times and bytes.
#include "operators/render/from_fields/field_costs.h"
#include "operators/render/from_fields/field_errors.h"
#include "operators/render/from_fields/field_memory.h"

#include <gtest/gtest.h>

#include <cmath>

namespace neumann::field_forecast_test {

FieldSettings settings(std::size_t patches, std::uint32_t rays, std::uint32_t samples) {
    FieldSettings s;
    s.reading = FieldReading::patches;
    s.patching.patches = patches;
    s.rays = s.light_samples = rays;
    s.samples = samples;
    return s;
}

const FieldSettings most = settings(250'000, 1 << 16, 1024);

// error² = A / samples + B / rays + C / max(rays, cells) + (D patches^-order)².
struct Parts {
    double A, B, C, D, order;
    std::uint32_t cells;
    PictureError of(const FieldSettings& s) const {
        return {std::sqrt(A / s.samples + B / s.rays + C / std::max(s.rays, cells)),
                D * std::pow(static_cast<double>(s.patching.patches), -order)};
    }
};

FieldErrors after(const Parts& parts, std::initializer_list<FieldSettings> renders) {
    FieldErrors errors(most);
    for (const FieldSettings& s : renders) errors.add(s, parts.cells, {parts.of(s)});
    return errors;
}

TEST(FieldForecast, ErrorsOfKnownPartsAreForetold) {
    const FieldSettings first = settings(500, 16, 1), second = settings(500, 16, 4), third = settings(4000, 64, 8);
    // Of diffuse surfaces; and with cells of directions, of which only more rays than cells help.
    for (const Parts& parts : {Parts{0.04, 0.08, 0.0, 2.0, 0.5, 1}, Parts{0.04, 0.02, 5.0, 2.0, 0.7, 256}}) {
        const FieldErrors errors = after(parts, {first, second, third});
        for (const FieldSettings& next :
             {settings(4000, 64, 32), settings(4000, 1024, 8), settings(16000, 64, 8), settings(9000, 512, 64)})
            EXPECT_NEAR(errors.predict(next).error, parts.of(next).all(), 1e-12 * parts.of(next).all());
    }
}

TEST(FieldForecast, StepsReachTheirTarget) {
    const Parts parts{0.01, 0.08, 0.0, 2.0, 0.5, 1};
    const FieldErrors errors = after(parts, {settings(500, 16, 1), settings(500, 16, 4)});
    for (const double target : {0.06, 0.03, 0.01}) {
        const FieldSettings next = errors.grow(target, 1e6);
        EXPECT_LE(parts.of(next).all(), target);
        const FieldSettings step = errors.grow(target, 8.0);
        EXPECT_LE(step.patching.patches, 4000u);
        EXPECT_LE(step.rays, 128u);
        EXPECT_LE(step.samples, 32u);
    }
}

// What cells of directions get wrong, more patches do not mend: they are not asked for.
TEST(FieldForecast, AnErrorThatStandsIsSeen) {
    const Parts stands{0.0, 0.01, 0.0, 0.3, 0.0, 256}, falls{0.0, 0.01, 0.0, 3.0, 0.5, 256};
    const FieldSettings first = settings(500, 16, 1), second = settings(500, 16, 4), third = settings(4000, 16, 4);
    const FieldErrors errors = after(stands, {first, second, third});
    EXPECT_FALSE(after(stands, {first, second}).stands(0));  // not known yet
    EXPECT_TRUE(errors.stands(0));
    EXPECT_FALSE(after(falls, {first, second, third}).stands(0));
    EXPECT_EQ(errors.grow(0.03, 8.0).patching.patches, 4000u);
    EXPECT_NEAR(errors.predict(settings(32000, 16, 4)).error, stands.of(third).all(), 1e-12);
}

// Seconds: 0.5 and a part like the rays of T; 0.1 and a part like the samples.
TEST(FieldForecast, Seconds) {
    Film film;
    film.crop_width = film.crop_height = 8;
    FieldCosts costs(film);
    const auto pictures = [&](const FieldSettings& s) {
        FieldPictures p(film, s);
        p.patches = s.patching.patches;
        p.sides = {{1, p.patches}, {256, p.patches / 10}};
        p.unknowns = p.patches + p.patches / 10 * 256;
        p.field_seconds = 0.5 + 1e-5 * static_cast<double>(p.patches * s.rays + p.patches / 10 * std::max(256u, s.rays));
        p.picture_seconds = 0.1 + 0.2 * s.samples;
        return p;
    };
    for (const FieldSettings& s : {settings(500, 16, 1), settings(500, 16, 4), settings(2000, 64, 8)})
        costs.add(s, pictures(s), pictures(s).field_seconds + pictures(s).picture_seconds);
    const FieldSettings next = settings(8000, 512, 32);
    const FieldPictures truth = pictures(next);
    EXPECT_NEAR(costs.predict(next).seconds, truth.field_seconds + truth.picture_seconds, 1e-9);
    const double rays = 8000.0 * 512.0 + 800.0 * 512.0;
    EXPECT_NEAR(costs.predict(next).bytes,
                bytes_of_fields(next, {8000.0, static_cast<double>(truth.unknowns), rays}) + 2.0 * bytes_of_pictures(next, film),
                1.0);
}

}  // namespace neumann::field_forecast_test
