// Materials of Mitsuba 0.4 to 0.6 that Mitsuba 3 does not have: what they mean in terms of others, their defaults, and messages.
#include "tests/reader/xml_scene_files.h"

namespace neumann::xml_older_bsdfs_test {

class XmlOlderBsdfs : public XmlTest {
protected:
    static std::string on_cube(const std::string& bsdf) { return "<shape type='cube'>" + bsdf + "</shape>"; }
    // What the front of the only shape is made of.
    Bsdf front(const std::string& bsdf) const { return side(read(on_cube(bsdf)), true).value(); }
    static std::optional<Bsdf> side(const SceneParts& parts, bool front) {
        const int index = front ? parts.sides_of_shape.at(0).front : parts.sides_of_shape.at(0).back;
        if (index == Materials::absorbing) return std::nullopt;
        return parts.bsdfs.at(static_cast<std::size_t>(index));
    }
    static std::string matt(const std::string& rgb) {
        return "<bsdf type='diffuse'><rgb name='reflectance' value='" + rgb + "'/></bsdf>";
    }
};

const Vec3 up(0, 0, 1), slant(0.6, 0, 0.8), other_slant = glm::normalize(Vec3(-0.3, 0.5, 0.4));

void expect_near(const Rgb& found, const Rgb& exact, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], exact[c], tolerance);
}

// Of matt materials: the weighted mean, and what is missing from 1 absorbs.
TEST_F(XmlOlderBsdfs, Mixtures) {
    const auto mixed = [&](const std::string& weights, const std::string& inside) {
        return eval(front("<bsdf type='mixturebsdf'><string name='weights' value='" + weights + "'/>" + inside + "</bsdf>"), {},
                    slant, other_slant) /
               inv_pi;
    };
    const std::string a = matt("1, 0, 0"), b = matt("0, 1, 0"), c = matt("0, 0, 1");
    expect_near(mixed("1", a), Rgb(1, 0, 0), 1e-15);
    expect_near(mixed("0.25", a), Rgb(0.25, 0, 0), 1e-15);
    expect_near(mixed("0.7, 0.3", a + b), Rgb(0.7, 0.3, 0), 1e-15);
    expect_near(mixed("0.5;0.3;0.1", a + b + c), Rgb(0.5, 0.3, 0.1), 1e-15);
    expect_near(mixed("0 0 0.4", a + b + c), Rgb(0, 0, 0.4), 1e-15);
    expect_near(mixed("0.1 0.2 0.3 0.05 0.15", a + b + c + b + a), Rgb(0.25, 0.25, 0.3), 1e-15);
    // Thirds add up to a little more than 1 if they are rounded up.
    expect_near(mixed("0.3333334, 0.3333334, 0.3333334", a + b + c), Rgb(1.0 / 3.0), 1e-6);
    EXPECT_EQ(largest_albedo(front("<bsdf type='mixturebsdf'><string name='weights' value='0.5, 0.25'/>" + a + b + "</bsdf>")),
              Rgb(0.5, 0.25, 0.0));
}

// A mixture of two is a blend.
TEST_F(XmlOlderBsdfs, AMixtureOfTwoIsABlend) {
    const std::string inside = "<bsdf type='roughconductor'><float name='alpha' value='0.3'/></bsdf>" + matt("0.2, 0.4, 0.6");
    const Bsdf mixture = front("<bsdf type='mixturebsdf'><string name='weights' value='0.75, 0.25'/>" + inside + "</bsdf>"),
               blend = front("<bsdf type='blendbsdf'><float name='weight' value='0.25'/>" + inside + "</bsdf>");
    EXPECT_EQ(eval(mixture, {}, slant, other_slant), eval(blend, {}, slant, other_slant));
    EXPECT_EQ(pdf(mixture, {}, slant, other_slant), pdf(blend, {}, slant, other_slant));
    EXPECT_EQ(lobe(mixture).alpha, 0.3);
}

// Each side of the mixture is of the same side of its parts; glass is seen from both.
TEST_F(XmlOlderBsdfs, SidesOfMixtures) {
    const SceneParts parts = read(on_cube("<bsdf type='mixturebsdf'><string name='weights' value='0.5, 0.5'/>" + matt("1, 1, 1") +
                                          "<bsdf type='dielectric'/></bsdf>"));
    EXPECT_TRUE(transmits(side(parts, true).value()));
    EXPECT_TRUE(transmits(side(parts, false).value()));
    EXPECT_EQ(eval(side(parts, false).value(), {}, slant, other_slant), Rgb(0.0));
    EXPECT_FALSE(side(read(on_cube("<bsdf type='mixturebsdf'><string name='weights' value='0.5, 0.4'/>" + matt("1, 1, 1") +
                                   matt("1, 0, 0") + "</bsdf>")),
                      false));
}

TEST_F(XmlOlderBsdfs, MixturesOfMany) {
    std::string weights, inside;
    constexpr int count = 3000;
    for (int i = 0; i < count; ++i) {
        weights += "0.0003,";
        inside += matt("1, 0.5, 0");
    }
    const Bsdf mixture = front("<bsdf type='mixturebsdf'><string name='weights' value='" + weights + "'/>" + inside + "</bsdf>");
    expect_near(eval(mixture, {}, slant, up) / inv_pi, Rgb(0.9, 0.45, 0.0), 1e-12);
}

TEST_F(XmlOlderBsdfs, ManyInsideEachOther) {
    std::string chain = "<bsdf type='diffuse' id='b0'/>";
    for (int i = 1; i < 300; ++i)
        chain += "\n<bsdf type='coating' id='b" + std::to_string(i) + "'><ref id='b" + std::to_string(i - 1) + "'/></bsdf>";
    const std::string message = error(chain + "\n" + on_cube("<ref id='b299'/>"));
    EXPECT_EQ(message.substr(message.find(": ") + 2, 35), "bsdfs are nested more than 100 deep");
}

TEST_F(XmlOlderBsdfs, Phong) {
    const Bsdf plain = front("<bsdf type='phong'/>");
    EXPECT_FALSE(side(read(on_cube("<bsdf type='phong'/>")), false));
    expect_near(eval(plain, {}, up, up), Rgb(0.5 * inv_pi + 0.2 * 32.0 / 2.0 * inv_pi), 1e-14);
    const Bsdf given = front(
        "<bsdf type='phong'><float name='exponent' value='8'/><rgb name='diffuse_reflectance' value='0.1, 0.2, 0.3'/>"
        "<float name='specular_reflectance' value='0.6'/></bsdf>");
    const double power = std::pow(glm::dot(Vec3(-slant.x, -slant.y, slant.z), other_slant), 8.0);
    expect_near(eval(given, {}, slant, other_slant), Rgb(0.1, 0.2, 0.3) * inv_pi + 0.6 * 5.0 * inv_pi * power, 1e-14);
}

TEST_F(XmlOlderBsdfs, Ward) {
    const auto peak = [&](const std::string& inside) {
        return eval(front("<bsdf type='ward'>" + inside + "</bsdf>"), {}, slant, slant);
    };
    // Along its own direction, H = 2 ω.
    const double t2 = 0.36 / 0.64;
    const auto e = [&](double alpha) { return std::exp(-t2 / (alpha * alpha)); };
    expect_near(peak("<float name='alpha_u' value='0.5'/><float name='alpha_v' value='0.4'/>"),
                Rgb(0.5 * inv_pi + 0.2 * e(0.5) * 4.0 * inv_pi / (0.5 * 0.4 * std::pow(1.6, 4))), 1e-14);
    expect_near(peak("<float name='alpha_u' value='0.5'/><string name='variant' value='ward'/>"
                     "<rgb name='diffuse_reflectance' value='0'/><rgb name='specular_reflectance' value='1, 0.5, 0'/>"),
                Rgb(1.0, 0.5, 0.0) * e(0.5) / (4.0 * pi * 0.5 * 0.1 * 0.8), 1e-14);
    expect_near(peak("<float name='alpha_u' value='0.5'/><string name='variant' value='ward-duer'/>"
                     "<rgb name='diffuse_reflectance' value='0'/><rgb name='specular_reflectance' value='1'/>"),
                Rgb(e(0.5) / (4.0 * pi * 0.5 * 0.1 * 0.64)), 1e-14);
}

// The names that files of these versions have.
TEST_F(XmlOlderBsdfs, InCamelCase) {
    const auto of_version = [&](const std::string& version, const std::string& bsdf) {
        return side(read_file("<scene version='" + version +
                              "'><sensor type='perspective'><float name='fov' value='40'/></sensor>" + on_cube(bsdf) + "</scene>"),
                    true)
            .value();
    };
    const Bsdf old = of_version("0.6.0",
                                "<bsdf type='ward'><float name='alphaU' value='0.5'/><float name='alphaV' value='0.2'/>"
                                "<rgb name='diffuseReflectance' value='0.3'/><rgb name='specularReflectance' value='0.4'/></bsdf>"),
               now =
                   of_version("3.0.0",
                              "<bsdf type='ward'><float name='alpha_u' value='0.5'/><float name='alpha_v' value='0.2'/>"
                              "<rgb name='diffuse_reflectance' value='0.3'/><rgb name='specular_reflectance' value='0.4'/></bsdf>");
    EXPECT_EQ(eval(old, {}, slant, other_slant), eval(now, {}, slant, other_slant));
    const Bsdf coat = of_version("0.6.0",
                                 "<bsdf type='coating'><float name='intIOR' value='1.5'/><float name='extIOR' value='1'/>"
                                 "<rgb name='sigmaA' value='0.1, 0.2, 0.3'/><float name='thickness' value='2'/>" +
                                     matt("1, 1, 1") + "</bsdf>");
    const double T = 1.0 - 0.04;
    expect_near(eval(coat, {}, up, up) / (T * T / 2.25 * inv_pi), glm::exp(-2.0 * 2.0 * Rgb(0.1, 0.2, 0.3)), 1e-12);
}

TEST_F(XmlOlderBsdfs, ReflectancesAboveOneAreScaled) {
    const std::string bsdf =
        "<bsdf type='phong'><float name='diffuse_reflectance' value='0.75'/>"
        "<float name='specular_reflectance' value='0.5'/>";
    const SceneParts parts = read(on_cube(bsdf + "</bsdf>"));
    expect_near(largest_albedo(side(parts, true).value()), Rgb(0.99), 1e-15);
    EXPECT_EQ(
        parts.warnings.counts(),
        (Warnings::Counts{
            {"diffuse_reflectance and specular_reflectance of bsdf 'phong' add up to 1.25: both scaled, to 0.99, as in Mitsuba "
             "0.6; ensure_energy_conservation = false keeps them",
             1}}));
    EXPECT_EQ(largest_albedo(front(bsdf + "<boolean name='ensure_energy_conservation' value='false'/></bsdf>")), Rgb(1.25));
}

TEST_F(XmlOlderBsdfs, Coatings) {
    // BK7 in air.
    const double F = std::pow((1.5046 - 1.000277) / (1.5046 + 1.000277), 2), eta = 1.5046 / 1.000277;
    const SceneParts parts = read(on_cube("<bsdf type='coating'>" + matt("0.3, 0.6, 0.9") + "</bsdf>"));
    expect_near(eval(side(parts, true).value(), {}, up, up), Rgb(0.3, 0.6, 0.9) * inv_pi * (1.0 - F) * (1.0 - F) / (eta * eta),
                1e-14);
    // From behind only the boundary reflects.
    const Bsdf back = side(parts, false).value();
    EXPECT_EQ(eval(back, {}, up, up), Rgb(0.0));
    EXPECT_NEAR(sample(back, {}, up, Vec2(0.5)).weight.g, F, 1e-14);
    EXPECT_EQ(sample(back, {}, up, Vec2(0.5)).pdf, delta_pdf);
    const Bsdf tinted =
        front("<bsdf type='coating'><rgb name='specular_reflectance' value='0, 0.5, 1'/><bsdf type='conductor'/></bsdf>");
    EXPECT_EQ(largest_albedo(tinted), Rgb(1.0));
    EXPECT_NEAR(sample(tinted, {}, up, Vec2(0.0)).weight.g / sample(tinted, {}, up, Vec2(0.0)).weight.b, 0.5, 1e-14);
}

}  // namespace neumann::xml_older_bsdfs_test
