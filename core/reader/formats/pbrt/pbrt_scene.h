// What a pbrt file says, before anything is made of it: its directives, with the state of the file where they stand.
#pragma once

#include "core/base/vec.h"
#include "core/reader/formats/pbrt/parameters.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace neumann::reader::pbrt {

// An object of a type, with parameters.
struct Entity {
    std::string type;
    Parameters parameters;
    Mat4 to_world{1.0};  // the transformation matrix where it stands

    const Location& place() const { return parameters.place(); }
};

struct TextureEntity : Entity {
    std::string name;
    bool is_float;  // numbers, otherwise colours
};

struct MaterialEntity : Entity {
    std::string name;  // empty if a directive Material makes it
};

// The material of a shape: the one of this name or, if the name is empty, the one of this number.
struct MaterialUse {
    std::string name = {};
    std::size_t number = 0;
    Location place = {};
};

struct ShapeEntity : Entity {
    bool reversed = false;  // by ReverseOrientation
    MaterialUse material;
    std::optional<std::size_t> light = {};  // number of its area light
};

struct Instance {
    std::string object;
    Mat4 to_world;
    Location place;
};

struct PbrtScene {
    explicit PbrtScene(const Location& start) : start(start) {}

    Location start;                       // the start of the main file, where what is missing is reported
    std::vector<std::string> files = {};  // in the order in which they were opened
    std::optional<Entity> camera = {}, film = {}, sampler = {}, integrator = {}, filter = {};
    std::vector<TextureEntity> textures = {};
    std::vector<MaterialEntity> materials = {};  // the first one is for shapes without a directive Material
    std::vector<Entity> lights = {}, area_lights = {};
    std::vector<ShapeEntity> shapes = {};
    struct Object {
        Location place;
        std::vector<ShapeEntity> shapes = {};
    };
    std::map<std::string, Object> objects = {};
    std::vector<Instance> instances = {};
};

}  // namespace neumann::reader::pbrt
