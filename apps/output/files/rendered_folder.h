// The folder of a finished render, read again.
#pragma once

#include "apps/output/files/shown_series.h"
#include "core/image/pixel_estimate.h"

#include <nlohmann/json.hpp>

#include <compare>
#include <filesystem>
#include <optional>
#include <string>

namespace neumann {

class RenderedFolder {
public:
    struct Size {
        int width, height;
        auto operator<=>(const Size&) const = default;
    };

    // Throws InputError, which begins with the file: no such file, or a run.json without something that the page shows.
    explicit RenderedFolder(const std::string& folder);

    const std::filesystem::path& path() const { return path_; }
    const nlohmann::ordered_json& run() const { return run_; }
    Size size() const { return size_; }
    std::size_t bounces() const { return run_.at("bounces").size(); }
    bool has_rest() const;
    std::size_t pictures() const { return bounces() + (has_rest() ? 1 : 0); }

    // The pictures, read when they are needed. Throws InputError if they are missing, damaged, or of another size.
    ShownSeries series() const;
    // Reads one of these files.
    PixelEstimate picture(const std::string& name) const;
    // The text of a file; nothing if there is none.
    std::optional<std::string> text(const std::string& name) const;

private:
    std::filesystem::path path_;
    nlohmann::ordered_json run_;
    Size size_;
};

}  // namespace neumann
