#include "apps/output/files/blame_files.h"

#include "apps/output/files/health_json.h"
#include "apps/output/files/json_number.h"
#include "core/image/image_io.h"

#include <fmt/format.h>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

Json triple(const Vec3& v) { return {json_number(v.x), json_number(v.y), json_number(v.z)}; }

std::string name_of_vertex(const PathVertex& vertex, const Scene& scene) {
    return vertex.shape == SurfacePoint::infinity ? "beyond the surfaces" : name_of_shape(scene, vertex.shape);
}

Json path_json(const OurPath& path, const Scene& scene) {
    Json vertices = Json::array();
    for (const PathVertex& v : path.vertices)
        vertices.push_back({{"shape", name_of_vertex(v, scene)},
                            {"lamp", scene.emitters.is_emitter(v.shape)},
                            {"at", triple(v.position)},
                            {"film", v.film ? Json{v.film->x, v.film->y} : Json(nullptr)}});
    return {{"sample", path.sample}, {"camera", triple(path.camera)}, {"vertices", vertices},          {"blocked", path.is_blocked},
            {"bounce", path.bounce}, {"value", triple(path.value)},   {"text", path_text(path, scene)}};
}

Json place_json(const WorstPlace& place, const Scene& scene) {
    return {{"x", place.x},
            {"y", place.y},
            {"width", place.width},
            {"height", place.height},
            {"z", json_number(place.z)},
            {"theirs", triple(place.theirs)},
            {"ours", triple(place.ours)},
            {"pixel", {place.pixel_x, place.pixel_y}},
            {"path", path_json(place.path, scene)}};
}

Json term_json(const TermVerdict& term, const Scene& scene) {
    Json worst = Json::array();
    for (const WorstPlace& place : term.worst) worst.push_back(place_json(place, scene));
    return {{"first", term.bounces.first},
            {"last", term.bounces.last},
            {"ratio", json_number(term.test.ratio)},
            {"ratio_stderr", json_number(term.test.ratio_error)},
            {"p", json_number(term.test.p)},
            {"threshold", term.threshold},
            {"differs", term.differs},
            {"unclear", term.doubt.has_value()},
            {"worst", worst}};
}

std::string numbered(const char* name, const BounceRange& bounces) {
    return bounces.first == bounces.last ? fmt::format("{}_{:03}.exr", name, bounces.last)
                                         : fmt::format("{}_{:03}-{:03}.exr", name, bounces.first, bounces.last);
}

}  // namespace

std::string path_text(const OurPath& path, const Scene& scene) {
    std::string text = "camera";
    for (std::size_t i = 0; i < path.vertices.size(); ++i) {
        const PathVertex& v = path.vertices[i];
        const bool is_last = i + 1 == path.vertices.size();
        text += fmt::format(" → {}{}{}", is_last && path.is_blocked ? "(hidden) " : "",
                            scene.emitters.is_emitter(v.shape) ? "lamp, " : "", name_of_vertex(v, scene));
    }
    return text;
}

Json blame_json(const Blame& found, const Scene& scene) {
    Json json;
    json["verdict"] = name_of(found.verdict());
    json["right"] = found.verdict() == Blame::Verdict::right;
    json["counting"] = name_of(found.counting);
    if (found.counting_by_the_data) json["counting_by_the_data"] = name_of(*found.counting_by_the_data);
    json["noise_known"] = found.knows_their_noise;
    json["samples"] = found.samples;
    json["sentences"] = found.sentences;
    json["terms"] = Json::array();
    for (const TermVerdict& t : found.terms) json["terms"].push_back(term_json(t, scene));
    json["suspects"] = Json::array();
    for (const Suspect& s : found.suspects)
        json["suspects"].push_back({{"name", s.name},
                                    {"words", s.words},
                                    {"misfit", json_number(s.misfit)},
                                    {"p_of_what_is_left", json_number(s.p_of_what_is_left)}});
    json["shapes"] = Json::array();
    for (const ShapeShare& s : found.shapes)
        json["shapes"].push_back({{"shape", name_of_vertex({s.shape, {}, {}}, scene)},
                                  {"share", json_number(s.share)},
                                  {"ratio", json_number(s.ratio)}});
    return json;
}

void write_blame_pictures(OutputFolder& folder, const Blame& found) {
    for (const TermVerdict& t : found.terms) {
        const auto attributes = [&](const char* quantity) {
            return Attributes{{"neumann:quantity", std::string(quantity)},
                              {"neumann:first_bounce", std::int64_t{t.bounces.first}},
                              {"neumann:last_bounce", std::int64_t{t.bounces.last}}};
        };
        folder.write(numbered("difference", t.bounces), encode_exr(t.difference, attributes("theirs less ours")));
        folder.write(numbered("z", t.bounces), encode_exr(Estimate{t.z, {}}, attributes("theirs less ours, in standard errors")));
    }
}

}  // namespace neumann
