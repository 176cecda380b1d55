// Executes the directives of pbrt files.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/formats/pbrt/graphics_state.h"
#include "core/reader/formats/pbrt/pbrt_scene.h"

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace neumann::reader::pbrt {

class DirectiveReader {
public:
    DirectiveReader(PbrtScene& scene, Warnings& warnings, Problems& problems);

    // Throws InputError if the file cannot be opened.
    void read_file(const std::string& path);
    // Reports what is still open after the last file.
    void check_end();

private:
    using Directive = std::function<void(const std::string&, const Location&)>;

    void add_options();
    void add_state_directives();
    void add_world_directives();
    // Add directives that may stand before WorldBegin, after it, or anywhere.
    void before_world(const std::string& name, Directive directive);
    void in_world(const std::string& name, Directive directive);
    void anywhere(const std::string& name, Directive directive) { directives_[name] = std::move(directive); }

    void execute(const Token& token);
    [[noreturn]] void fail_unknown(const Token& token);
    std::vector<std::string> known_directives() const;
    // Whether a file of pbrt may begin with the token.
    bool may_begin(const Token& first) const;
    void skip_to_directive();

    Tokens& tokens() { return *files_.back().tokens; }
    std::string string_argument(const std::string& directive, const Location& place, const char* what);
    std::vector<double> number_arguments(const std::string& directive, const Location& place, std::size_t count);
    Parameters parameters(const std::string& title, const Location& place, const std::string& defaults = "");
    Entity entity(const std::string& directive, const Location& place, const std::string& noun, const std::string& defaults = "");

    void set_option(std::optional<Entity>& option, const std::string& directive, const Location& place, const std::string& noun);
    void option(const Location& place);
    void camera(const Location& place);
    void attribute(const Location& place);
    void push(char kind, const Location& place);
    void pop(char kind, const std::string& directive, const Location& place);
    void material(const Location& place);
    void named_material(const Location& place);
    void texture(const Location& place);
    void area_light(const Location& place);
    void shape(const Location& place);
    void object_begin(const Location& place);
    void object_end(const Location& place);
    void object_instance(const Location& place);
    void medium_interface(const Location& place);
    void include(const std::string& directive, const Location& place);

    PbrtScene& scene_;
    Warnings& warnings_;
    Problems& problems_;
    std::map<std::string, Directive> directives_;
    struct OpenFile {
        std::string path;
        Tokens* tokens;
    };
    std::vector<OpenFile> files_;  // each is included by the one before
    GraphicsState state_;
    struct Pushed {
        char kind;  // a: AttributeBegin, o: ObjectBegin, t: TransformBegin
        Location place;
        GraphicsState state;
    };
    std::vector<Pushed> pushed_;
    std::map<std::string, Mat4> coordinate_systems_;
    std::set<std::string> media_;
    std::map<std::string, Location> named_materials_;
    PbrtScene::Object* object_ = nullptr;  // the object being defined
    bool is_in_world_ = false;
};

}  // namespace neumann::reader::pbrt
