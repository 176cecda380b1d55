// Scene files in a folder of their own, and what the reader makes of them.
#pragma once

#include "core/reader/read_scene.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace neumann {

using Definitions = std::map<std::string, std::string>;

class XmlTest : public ::testing::Test {
protected:
    XmlTest() {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        std::string name = std::string(info->test_suite_name()) + "." + info->name();
        std::ranges::replace(name, '/', '.');
        folder_ = std::filesystem::path(::testing::TempDir()) / name;
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    ~XmlTest() override { std::filesystem::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    void write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }

    // `body` begins on line 2; a sensor comes after it.
    static std::string scene(const std::string& body) {
        return "<scene version=\"3.0.0\">\n" + body +
               "\n<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor>\n</scene>\n";
    }

    SceneParts read_file(const std::string& text, const Definitions& definitions = {}) const {
        write("scene.xml", text);
        return read_scene_parts(path("scene.xml"), definitions);
    }
    SceneParts read(const std::string& body, const Definitions& definitions = {}) const {
        return read_file(scene(body), definitions);
    }

    // The whole message, without the folder.
    std::string file_error(const std::string& text, const Definitions& definitions = {}) const {
        write("scene.xml", text);
        return error_of(path("scene.xml"), definitions);
    }
    std::string error(const std::string& body, const Definitions& definitions = {}) const {
        return file_error(scene(body), definitions);
    }
    std::string error_of(const std::string& scene_path, const Definitions& definitions = {}) const {
        try {
            read_scene_parts(scene_path, definitions);
        } catch (const InputError& e) {
            std::string what = e.what();
            for (std::size_t at; (at = what.find(folder_.string() + "/")) != std::string::npos;)
                what.erase(at, folder_.string().size() + 1);
            for (std::size_t at; (at = what.find(folder_.string())) != std::string::npos;)
                what = what.substr(0, at) + "." + what.substr(at + folder_.string().size());
            return what;
        }
        return "no error";
    }

private:
    std::filesystem::path folder_;
};

}  // namespace neumann
