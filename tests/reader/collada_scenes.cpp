// The scenes of COLLADA files: nodes, cameras, lights and materials.
#include "tests/reader/collada_files.h"

#include <fmt/format.h>

namespace neumann::collada_scenes_test {

using ColladaScenes = ColladaTest;

const std::string transforms = "<translate>1 2 3</translate><scale>2 2 2</scale>",
                  lens = "<xfov>60</xfov><aspect_ratio>2</aspect_ratio>";

TEST_F(ColladaScenes, TransformsInTheirOrder) {
    // Where the corner (1, -1, 0) comes to.
    const auto corner = [&](const std::string& text) { return corners(mesh(read_changed({{transforms, text}}))).at(1); };
    const auto expect = [&](const std::string& text, const Vec3& p) {
        EXPECT_NEAR(glm::distance(corner(text), p), 0.0, 1e-14) << text;
    };
    expect("<translate>1 2 3</translate><rotate>0 0 1 90</rotate>", {2, 3, 3});
    expect("<rotate>0 0 1 90</rotate><translate>1 2 3</translate>", {-1, 2, 3});
    expect("<matrix>0 -1 0 5 1 0 0 6 0 0 1 7 0 0 0 1</matrix><scale>3 1 1</scale>", {6, 9, 7});
    // At (5, 0, 0), −z towards the origin, +y up: +x is −z of the world.
    expect("<lookat>5 0 0 0 0 0 0 1 0</lookat>", {5, -1, -1});
    expect("<translate>10 0 0</translate><node/>", {11, -1, 0});
}

// A lenient reader takes the mesh of a skin as it was bound to its joints.
TEST_F(ColladaScenes, SkinsUnbent) {
    const std::string text = changed(
        {{"<instance_geometry url=\"#square\">", "<instance_controller url=\"#skin\">"},
         {"</instance_geometry>", "</instance_controller>"},
         {"<library_visual_scenes>",
          "<library_controllers><controller id=\"skin\"><skin source=\"#square\"><bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 5 0 0 0 1"
          "</bind_shape_matrix></skin></controller></library_controllers><library_visual_scenes>"}});
    write("scene.dae", text);
    const SceneParts parts = read_scene_parts(path("scene.dae"), {}, {.lenient = true});
    // The node's translation and scale after the matrix of the skin.
    const std::vector<Vec3> moved = {{-1, 0, 13}, {3, 0, 13}, {3, 4, 13}, {-1, 0, 13}, {3, 4, 13}, {-1, 4, 13}};
    EXPECT_EQ(corners(mesh(parts)), moved);
    ASSERT_EQ(parts.replaced.size(), 1u);
    EXPECT_TRUE(parts.replaced[0].ends_with("<instance_controller> is not supported; its mesh is taken unbent"))
        << parts.replaced[0];
    EXPECT_EQ(dae_error(text).find("posed mesh") == std::string::npos, false);
}

TEST_F(ColladaScenes, NodesInNodes) {
    const SceneParts parts = read_changed(
        {{"<library_visual_scenes>",
          "<library_nodes><node id='pair'><translate>0 0 1</translate><node><scale>2 2 2</scale>"
          "<instance_geometry url='#square'/></node><instance_geometry url='#square'/></node></library_nodes>"
          "<library_visual_scenes>"},
         {"<node id=\"floor\">", "<node><rotate>0 0 1 180</rotate><instance_node url='#pair'/></node><node id=\"floor\">"}});
    ASSERT_EQ(parts.shapes.size(), 3u);
    EXPECT_NEAR(glm::distance(corners(mesh(parts, 0)).at(1), Vec3(-2, 2, 1)), 0.0, 1e-14);
    EXPECT_NEAR(glm::distance(corners(mesh(parts, 1)).at(1), Vec3(-1, 1, 1)), 0.0, 1e-14);
    EXPECT_EQ(warnings(parts),
              std::vector<std::string>{"no material is bound to a part of a geometry, which is taken as diffuse with "
                                       "the albedo 0.5"});
}

TEST_F(ColladaScenes, Cameras) {
    const SceneParts parts = read_dae(small());
    // Mitsuba's camera looks along +z, with +x to the left.
    EXPECT_EQ(parts.camera.to_world, Mat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 5, 1));
    EXPECT_EQ(parts.camera.fov, glm::radians(60.0));
    EXPECT_EQ(parts.camera.near_clip, 0.1);
    EXPECT_EQ(parts.camera.far_clip, 90.0);
    EXPECT_EQ(parts.film.width, 768);
    EXPECT_EQ(parts.film.height, 384);
    EXPECT_EQ(parts.sampler, SamplerKind::sobol);

    const auto film_height = [&](const std::string& text) { return read_changed({{lens, text}}).film.height; };
    EXPECT_EQ(film_height("<xfov>60</xfov>"), 576);
    EXPECT_EQ(film_height("<xfov>90</xfov><yfov>53.13010235415598</yfov>"), 384);  // tan 45° is twice tan 26.6°
    const SceneParts high = read_changed({{lens, "<yfov>50</yfov><aspect_ratio>0.5</aspect_ratio>"}});
    EXPECT_EQ(high.camera.fov_axis, FovAxis::y);
    EXPECT_EQ(high.film.height, 1536);

    const SceneParts flat = read_changed({{lens, "<ymag>3</ymag><aspect_ratio>2</aspect_ratio>"},
                                          {"<perspective>", "<orthographic>"},
                                          {"</perspective>", "</orthographic>"}});
    EXPECT_EQ(flat.camera.kind, SensorOptions::Kind::orthographic);
    EXPECT_EQ(Vec3(flat.camera.to_world[0]), Vec3(-6, 0, 0));
    const SceneParts wide = read_changed(
        {{lens, "<xmag>6</xmag><ymag>3</ymag>"}, {"<perspective>", "<orthographic>"}, {"</perspective>", "</orthographic>"}});
    EXPECT_EQ(Vec3(wide.camera.to_world[0]), Vec3(-6, 0, 0));
    EXPECT_EQ(wide.film.height, 384);

    const SceneParts scaled = read_changed({{"<translate>0 0 5</translate>", "<translate>0 0 5</translate><scale>7 7 7</scale>"}});
    EXPECT_EQ(scaled.camera.to_world, parts.camera.to_world);
}

TEST_F(ColladaScenes, Definitions) {
    const SceneParts parts =
        read_dae(small(), {{"width", "32"}, {"height", "16"}, {"spp", "4"}, {"camera", "1 0 0 0 0 1 0 0 0 0 1 -9 0 0 0 1"}});
    EXPECT_EQ(parts.film.width, 32);
    EXPECT_EQ(parts.film.height, 16);
    EXPECT_EQ(read_dae(small(), {{"width", "50"}}).film.height, 25);  // the file says 2 : 1
    EXPECT_EQ(read_dae(small(), {{"height", "50"}}).film.width, 100);
    EXPECT_EQ(Vec3(parts.camera.to_world[3]), Vec3(0, 0, -9));
}

// The whole scene from its front: the square [-1, 3] × [0, 4] at z = 3, the radius of whose sphere is √8.
TEST_F(ColladaScenes, NoCamera) {
    const SceneParts parts = read_changed({{"<instance_camera url=\"#cam\"/>", ""}});
    EXPECT_NEAR(glm::distance(Vec3(parts.camera.to_world[3]), Vec3(1, 2 - 3 * std::sqrt(8.0), 3)), 0.0, 1e-13);
    EXPECT_NEAR(glm::distance(Vec3(parts.camera.to_world[2]), Vec3(0, 1, 0)), 0.0, 1e-15);
    EXPECT_NEAR(glm::distance(Vec3(parts.camera.to_world[1]), Vec3(0, 0, 1)), 0.0, 1e-15);
    EXPECT_EQ(warnings(parts), std::vector<std::string>{"the file has no camera; the whole scene is seen from the front"});
}

TEST_F(ColladaScenes, WithoutLightsThereAreSurroundings) {
    const Changes none = {{"<instance_light url=\"#lamp\"/>", ""}};
    const SceneParts parts = read_changed(none);
    ASSERT_TRUE(parts.lights.environment.has_value());
    EXPECT_EQ(warnings(parts), std::vector<std::string>{
                                   "the file has no light: everything is surrounded by white light of radiance 1, or of another "
                                   "that -D surroundings gives"});
    EXPECT_TRUE(read_dae(changed(none), {{"surroundings", "0.5"}}).lights.environment.has_value());
    EXPECT_FALSE(read_changed({}).lights.environment.has_value());
}

// Some programs write the same element several times; where it differs, nobody knows which is meant.
TEST_F(ColladaScenes, ElementsWithTheSameId) {
    const std::string red = "<material id=\"red\"><instance_effect url=\"#paint-effect\"/></material>";
    EXPECT_EQ(read_changed({{red, red + "\n" + red}}).shapes.size(), 1u);
}

TEST_F(ColladaScenes, Lights) {
    const std::string point =
        "<point><color>1 2 "
        "3</color><constant_attenuation>0</constant_attenuation><quadratic_attenuation>0.5</quadratic_attenuation></point>";
    const auto light = [&](const std::string& text) { return read_changed({{point, text}}); };
    const auto arrives = [&](const std::string& text, const Vec3& at) {
        return beam(light(text).lights.delta.at(0), at, {}).irradiance;
    };
    // color / (0.5 r²), at a distance of 2 from (0, 0, 2).
    EXPECT_EQ(arrives(point, {0, 0, 0}), Rgb(0.5, 1.0, 1.5));
    // What falls off otherwise agrees at the distance 1.
    EXPECT_EQ(arrives("<point><color>4 4 4</color><linear_attenuation>1</linear_attenuation></point>", {0, 0, 1}), Rgb(2.0));
    EXPECT_EQ(warnings(light("<point><color>4 4 4</color></point>")),
              std::vector<std::string>{
                  "a light falls off otherwise than with the square of the distance; it is taken as one that does, as "
                  "bright as that at the distance 1"});
    EXPECT_EQ(arrives("<directional><color>1 2 3</color></directional>", {0, 0, 0}), Rgb(1, 2, 3));
    EXPECT_GT(beam(light("<directional><color>1 2 3</color></directional>").lights.delta.at(0), {}, {}).from.z, -1e-15);
    // A full angle; the edge is sharp without an exponent.
    const std::string spot =
        "<spot><color>1 1 1</color><quadratic_attenuation>1</quadratic_attenuation><constant_attenuation>0"
        "</constant_attenuation><falloff_angle>90</falloff_angle></spot>";
    EXPECT_EQ(arrives(spot, {0.99, 0, 1}), Rgb(1 / (1 + 0.99 * 0.99)));
    EXPECT_EQ(arrives(spot, {1.01, 0, 1}), Rgb(0.0));
    EXPECT_EQ(radiance(light("<ambient><color>1 2 3</color></ambient>").lights.environment.value(), {0, 0, -1}), Rgb(1, 2, 3));
}

// A spot light of cos² and the linear one that is taken for it give off the same power: ∫ cos²θ sinθ dθ to 45° is (1 − 2^-1.5) / 3.
TEST_F(ColladaScenes, SpotOfTheSamePower) {
    const SceneParts parts = read_changed(
        {{"<point><color>1 2 "
          "3</color><constant_attenuation>0</constant_attenuation><quadratic_attenuation>0.5</quadratic_attenuation></point>",
          "<spot><color>3 3 3</color><constant_attenuation>0</constant_attenuation><quadratic_attenuation>1</quadratic_attenuation>"
          "<falloff_angle>90</falloff_angle><falloff_exponent>2</falloff_exponent></spot>"}});
    double power = 0.0;
    constexpr int steps = 10000;
    for (int i = 0; i < steps; ++i) {
        const double theta = (i + 0.5) * 0.25 * M_PI / steps;
        power += beam(parts.lights.delta.at(0), Vec3(std::sin(theta), 0, 2 - std::cos(theta)), {}).irradiance.r * std::sin(theta);
    }
    EXPECT_NEAR(power * 0.25 * M_PI / steps, 1.0 - std::pow(2.0, -1.5), 1e-7);
}

TEST_F(ColladaScenes, Materials) {
    const std::string lambert = "<lambert><diffuse><color>0.6 0.2 0.1 1</color></diffuse></lambert>";
    const auto material = [&](const std::string& text) { return read_changed({{lambert, text}}); };
    const SceneParts red = read_dae(small());
    EXPECT_TRUE(std::holds_alternative<Diffuse>(front(red)));
    EXPECT_EQ(largest_albedo(front(red)), Rgb(0.6, 0.2, 0.1));
    EXPECT_EQ(red.sides_of_shape.at(0).front, red.sides_of_shape.at(0).back);
    EXPECT_TRUE(warnings(red).empty());

    const SceneParts lamp = material("<constant><emission><color>4 5 6</color></emission></constant>");
    EXPECT_EQ(lamp.sides_of_shape.at(0).front, Materials::absorbing);
    EXPECT_EQ(lamp.lights.of_shape.at(0), 0);

    EXPECT_EQ(
        warnings(material("<phong><diffuse><color>1 1 1</color></diffuse><specular><color>0.5 0.5 0.5</color></specular><shininess>"
                          "<float>50</float></shininess></phong>")),
        std::vector<std::string>{
            "material 'red': its highlights are left out: <specular> and <shininess> are no law of reflection"});
    EXPECT_EQ(warnings(material(
                  "<lambert><diffuse><color>1 1 1</color></diffuse><reflectivity><float>0.5</float></reflectivity></lambert>")),
              std::vector<std::string>{"material 'red': its mirror image, <reflective>, is left out"});

    const SceneParts refracts = material(
        "<lambert><diffuse><color>0.6 0.2 0.1 1</color></diffuse><index_of_refraction><float>1.5</float></index_of_refraction>"
        "</lambert>");
    EXPECT_EQ(largest_albedo(front(refracts)), Rgb(0.6, 0.2, 0.1));
    EXPECT_TRUE(warnings(refracts).empty());

    const SceneParts by_parameter = read_changed(
        {{"<technique sid=\"common\">", "<newparam sid='c'><float3>0.1 0.2 0.3</float3></newparam><technique sid=\"common\">"},
         {"<color>0.6 0.2 0.1 1</color>", "<param ref='c'/>"}});
    EXPECT_EQ(largest_albedo(front(by_parameter)), Rgb(0.1, 0.2, 0.3));
}

// The four ways of saying how opaque a material is, and what programs write without one.
TEST_F(ColladaScenes, Opacity) {
    const auto opacity = [&](const std::string& text) {
        const SceneParts parts = read_changed({{"</diffuse>", "</diffuse>" + text}});
        if (!std::holds_alternative<Mask>(front(parts))) return 1.0;
        // A mask lets a ray pass with the weight 1 − opacity as its probability.
        double passed = 0.0;
        constexpr int steps = 1000;
        for (int i = 0; i < steps; ++i) passed += sample(front(parts), {}, Vec3(0, 0, 1), Vec2((i + 0.5) / steps, 0.5)).wi.z < 0.0;
        return 1.0 - passed / steps;
    };
    const std::string half = "<transparency><float>0.5</float></transparency>";
    EXPECT_EQ(opacity(""), 1.0);
    EXPECT_EQ(opacity("<transparency><float>1</float></transparency>"), 1.0);
    EXPECT_NEAR(opacity(half), 0.5, 1e-9);
    EXPECT_NEAR(opacity("<transparent><color>1 1 1 0.5</color></transparent>" + half), 0.25, 1e-9);
    EXPECT_NEAR(opacity("<transparent opaque='A_ZERO'><color>1 1 1 0.5</color></transparent>" + half), 0.75, 1e-9);
    EXPECT_NEAR(opacity("<transparent opaque='RGB_ZERO'><color>0.2 0.2 0.2 1</color></transparent>" + half), 0.9, 1e-9);
    EXPECT_NEAR(opacity("<transparent opaque='RGB_ONE'><color>0.2 0.2 0.2 1</color></transparent>" + half), 0.1, 1e-9);
}

// By way of a sampler and a surface, with the names of files that programs write.
TEST_F(ColladaScenes, Pictures) {
    const auto albedo = [&](const std::string& address) {
        return largest_albedo(front(read_changed(
                                  {{"<technique sid=\"common\">",
                                    "<newparam sid='s'><surface type='2D'><init_from>image</init_from></surface></newparam>"
                                    "<newparam sid='m'><sampler2D><source>s</source><wrap_s>CLAMP</wrap_s><wrap_t>CLAMP</wrap_t>"
                                    "</sampler2D></newparam><technique sid=\"common\">"},
                                   {"<color>0.6 0.2 0.1 1</color>", "<texture texture='m' texcoord='UV'/>"},
                                   {"<library_effects>", "<library_images><image id='image'><init_from>" + address +
                                                             "</init_from></image></library_images><library_effects>"},
                                   {"<vertices id=\"corners\">",
                                    "<vertices id=\"corners\"><input semantic='TEXCOORD' source='#positions'/>"}})))
            .r;
    };
    write("my pictures/größe 1.pfm", std::string("Pf\n1 1\n-1.0\n") + std::string("\0\0\0\x3f", 4));  // 0.5
    EXPECT_EQ(albedo("my pictures/größe 1.pfm"), 0.5);
    EXPECT_EQ(albedo("./my%20pictures/gr%C3%B6%C3%9Fe%201.pfm"), 0.5);
    EXPECT_EQ(albedo("my pictures\\größe 1.pfm"), 0.5);
    EXPECT_EQ(albedo("file://" + path("my%20pictures/größe 1.pfm")), 0.5);
    write("beside.pfm", std::string("Pf\n1 1\n-1.0\n") + std::string("\0\0\x80\x3e", 4));  // 0.25
    EXPECT_EQ(albedo("file:///C:/Users/someone/beside.pfm"), 0.25);
}

// Beyond its edges; v counts from the lowest row.
TEST_F(ColladaScenes, PicturesGoOn) {
    write("a.pfm", std::string("Pf\n2 1\n-1.0\n") + std::string("\0\0\x80\x3e\0\0\0\x3f", 8));  // 0.25, 0.5
    const auto beyond = [&](const std::string& mode) {
        const SceneParts parts = read_changed(
            {{"<technique sid=\"common\">",
              "<newparam sid='s'><surface type='2D'><init_from>image</init_from></surface></newparam>"
              "<newparam sid='m'><sampler2D><source>s</source><wrap_s>" +
                  mode + "</wrap_s><wrap_t>" + mode + "</wrap_t></sampler2D></newparam><technique sid=\"common\">"},
             {"<color>0.6 0.2 0.1 1</color>", "<texture texture='m' texcoord='UV'/>"},
             {"<library_effects>",
              "<library_images><image id='image'><init_from>a.pfm</init_from></image></library_images><library_effects>"},
             {"<vertices id=\"corners\">", "<vertices id=\"corners\"><input semantic='TEXCOORD' source='#positions'/>"}});
        return std::pair(reflectance(front(parts), point_with_coordinates({1.25, 0.5})).r,
                         reflectance(front(parts), point_with_coordinates({-0.25, 0.5})).r);
    };
    EXPECT_EQ(beyond("WRAP"), std::pair(0.25, 0.5));
    EXPECT_EQ(beyond("MIRROR"), std::pair(0.5, 0.25));
    EXPECT_EQ(beyond("CLAMP"), std::pair(0.5, 0.25));
    EXPECT_EQ(beyond("BORDER"), std::pair(0.5, 0.25));
}

TEST_F(ColladaScenes, LeftOut) {
    const SceneParts moving = read_changed({{"<library_visual_scenes>",
                                             "<library_animations><animation id='a'/></library_animations>"
                                             "<library_visual_scenes>"}});
    EXPECT_EQ(warnings(moving), std::vector<std::string>{"animations are left out: the scene is as its nodes have it"});
    const SceneParts coloured =
        read_changed({{"<vertices id=\"corners\">", "<vertices id=\"corners\"><input semantic='COLOR' source='#positions'/>"}});
    ASSERT_EQ(warnings(coloured).size(), 1u);
    EXPECT_NE(warnings(coloured).front().find("colo"), std::string::npos) << warnings(coloured).front();
    EXPECT_EQ(largest_albedo(front(coloured)), Rgb(0.6, 0.2, 0.1));
}

// 10 nodes that hold the next ten times each are refused, and not visited 10¹⁰ times.
TEST_F(ColladaScenes, TooManyInstances) {
    std::string nodes = "<library_nodes>";
    for (int i = 0; i < 10; ++i) {
        nodes += fmt::format("<node id='n{}'>", i);
        for (int j = 0; j < 10 && i < 9; ++j) nodes += fmt::format("<instance_node url='#n{}'/>", i + 1);
        nodes += "</node>";
    }
    const std::string message = error_with({{"<library_visual_scenes>", nodes + "</library_nodes><library_visual_scenes>"},
                                            {"<node id=\"floor\">", "<instance_node url='#n0'/><node id=\"floor\">"},
                                            {"<node id=\"eye\">", "<node><instance_node url='#n0'/></node><node id=\"eye\">"}});
    EXPECT_NE(message.find("there are more than 262144 nodes and instances of nodes"), std::string::npos) << message.substr(0, 500);
}

}  // namespace neumann::collada_scenes_test
