// Colours, and <spectrum> in all its forms.
#include "tests/reader/xml_scene_files.h"

namespace neumann::xml_spectra_test {

class XmlSpectra : public XmlTest {
protected:
    Rgb radiance(const std::string& spectrum) const {
        return read("<shape type='cube'><emitter type='area'>" + spectrum + "</emitter></shape>").lights.area.at(0).largest;
    }
    Rgb reflectance(const std::string& spectrum) const {
        return largest_albedo(read("<shape type='cube'><bsdf type='diffuse'>" + spectrum + "</bsdf></shape>").bsdfs.at(0));
    }
    static std::string object(const std::string& type, const std::string& inside) {
        return "<spectrum name='radiance' type='" + type + "'>" + inside + "</spectrum>";
    }
};

TEST_F(XmlSpectra, Files) {
    write("lamps/lamp.spd", "# nm  value\n400 0\n500\t8 # blue\r\n\n  600 15.6\n700 18.4");
    const std::string list = "<spectrum name='radiance' value='400:0, 500:8, 600:15.6, 700:18.4'/>";
    EXPECT_EQ(radiance("<spectrum name='radiance' filename='lamps/lamp.spd'/>"), radiance(list));
    // The file is part of what the scene's hash tells.
    const std::string body =
        "<shape type='cube'><emitter type='area'><spectrum name='radiance' filename='lamps/lamp.spd'/></emitter></shape>";
    const std::string before = read(body).hash;
    write("lamps/lamp.spd", "400 0\n700 18");
    EXPECT_NE(read(body).hash, before);
}

// A radiance that is the same at all wavelengths has X = Y = Z, which is the sum of the matrix' rows and not white; numbers and rgb
// are white. A reflectance is grey.
TEST_F(XmlSpectra, OneValue) {
    const Rgb equal_energy = radiance("<spectrum name='radiance' value='2'/>");
    EXPECT_NEAR(equal_energy.r, 2.0 * 1.204794, 1e-12);
    EXPECT_NEAR(equal_energy.g, 2.0 * 0.948291, 1e-12);
    EXPECT_NEAR(equal_energy.b, 2.0 * 0.908916, 1e-12);
    const Rgb list = radiance("<spectrum name='radiance' value='360:2, 830:2'/>");
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(equal_energy[i], list[i], 1e-3);
    EXPECT_EQ(radiance("<float name='radiance' value='2'/>"), Rgb(2.0));
    EXPECT_EQ(radiance("<rgb name='radiance' value='2'/>"), Rgb(2.0));
    EXPECT_EQ(reflectance("<spectrum name='reflectance' value='0.5'/>"), Rgb(0.5));
}

TEST_F(XmlSpectra, Objects) {
    EXPECT_EQ(radiance(object("uniform", "<float name='value' value='3'/>")), Rgb(3.0));
    EXPECT_EQ(radiance(object("d65", "<float name='scale' value='3'/>")), Rgb(3.0));
    EXPECT_EQ(radiance(object("d65", "")), Rgb(1.0));
    const Rgb list = radiance("<spectrum name='radiance' value='400:1, 500:2, 600:4'/>");
    EXPECT_EQ(
        radiance(object("irregular", "<string name='wavelengths' value='400, 500, 600'/><string name='values' value='1 2 4'/>")),
        list);
    EXPECT_EQ(radiance(object("regular",
                              "<float name='wavelength_min' value='400'/><float name='wavelength_max' value='600'/>"
                              "<string name='values' value='1, 2, 4'/>")),
              list);
    EXPECT_EQ(reflectance("<spectrum name='reflectance' type='uniform'><float name='value' value='0.25'/></spectrum>"), Rgb(0.25));
}

TEST_F(XmlSpectra, BlackBodies) {
    const Rgb warm = radiance(object("blackbody", "<float name='temperature' value='2856'/>"));
    EXPECT_GT(warm.r, warm.g);
    EXPECT_GT(warm.g, warm.b);
    // The candela was 1/60 of what 1 cm² of a black body gives off at the freezing point of platinum, 2041.4 K; laboratories
    // realised it within 1%.
    const Rgb platinum = radiance(object("blackbody", "<float name='temperature' value='2041.4'/>"));
    const double y = 0.2126 * platinum.r + 0.7152 * platinum.g + 0.0722 * platinum.b;
    EXPECT_NEAR(683.0 * 106.857 * y, 6e5, 6e3);
    const Rgb part =
        radiance(object("blackbody", "<float name='temperature' value='2856'/><float name='wavelength_min' value='600'/>"));
    EXPECT_LT(part.g, warm.g);
}

TEST_F(XmlSpectra, Colours) {
    EXPECT_EQ(reflectance("<rgb name='reflectance' value='0.1, +0.2 3e-1'/>"), Rgb(0.1, 0.2, 0.3));
    EXPECT_EQ(reflectance("<rgb name='reflectance' value='0.5'/>"), Rgb(0.5));
    EXPECT_EQ(reflectance("<rgb name='reflectance' value='2'/>"), Rgb(2.0));
    EXPECT_EQ(reflectance("<spectrum name='reflectance' value=' 0.25 '/>"), Rgb(0.25));
    EXPECT_EQ(reflectance("<integer name='reflectance' value='1'/>"), Rgb(1.0));
    const Rgb hex = reflectance("<rgb name='reflectance' value='#ff8000'/>");
    EXPECT_DOUBLE_EQ(hex.r, 1.0);
    EXPECT_NEAR(hex.g, 0.2158605, 1e-7);
    EXPECT_EQ(hex.b, 0.0);
}

TEST_F(XmlSpectra, Wavelengths) {
    const Rgb white = reflectance("<spectrum name='reflectance' value='360:0.5, 830:0.5'/>");
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(white[i], 0.5, 1e-4);
    const SceneParts parts =
        read("<shape type='cube'><emitter type='area'><spectrum name='radiance' value='360:2, 830:2'/></emitter></shape>");
    const Rgb lamp = parts.lights.area.at(0).largest;
    EXPECT_NEAR(lamp.r, 2.0 * 1.2048, 1e-3);
    EXPECT_NEAR(lamp.g, 2.0 * 0.9483, 1e-3);
    EXPECT_NEAR(lamp.b, 2.0 * 0.9089, 1e-3);
    EXPECT_TRUE(parts.warnings.counts().empty());
}

TEST_F(XmlSpectra, WavelengthsOutsideSrgb) {
    const SceneParts parts = read(
        "<shape type='cube'><bsdf type='diffuse'>"
        "<spectrum name='reflectance' value='500:1 520:1'/></bsdf></shape>");
    const Rgb green = largest_albedo(parts.bsdfs.at(0));
    EXPECT_EQ(green.r, 0.0);  // negative before
    EXPECT_GT(green.g, 0.1);
    EXPECT_EQ(parts.warnings.counts(), (Warnings::Counts{{"spectrum outside the colours of sRGB, cut to them", 1}}));
}

}  // namespace neumann::xml_spectra_test
