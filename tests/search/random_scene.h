// Small scenes made by chance, as files of Mitsuba 3 that anybody can render: shapes of all kinds, each with any material and maybe
// shining, turned and scaled; lights of all kinds; cameras of all kinds.
#pragma once

#include "tests/search/random_numbers.h"

#include <pugixml.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace neumann::search {

struct RandomScene {
    pugi::xml_document xml;
    std::map<std::string, std::string> files;  // meshes and pictures that stand beside it, by their names
    std::vector<std::string> methods;          // that are compared in it, as words of read_method()
};

RandomScene random_scene(std::uint64_t number);

void write(const pugi::xml_document& xml, const std::filesystem::path& path);
void write_files(const RandomScene& scene, const std::filesystem::path& folder);

}  // namespace neumann::search
