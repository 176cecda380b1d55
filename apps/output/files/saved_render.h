// A render under way on disk, so that another process can go on with it (state_file.h). The numbers are moments, ranges of samples
// and errors by samples; or fields and the pixels that were read from them (saved_fields.h).
#pragma once

#include "apps/output/files/output_folder.h"
#include "operators/render/methods/saving.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace neumann {

// What was asked for.
struct RequestOnDisk {
    nlohmann::ordered_json request;  // of a render, by its options (request_json.h)
    std::string scene_hash;
};

void save_render(OutputFolder& folder, const RequestOnDisk& request, const RecordedRender& render,
                 const std::optional<MethodChoice>& choice, const RenderedSeries& series);

void save_fields(OutputFolder& folder, const RequestOnDisk& request, const RecordedRender& render,
                 const std::optional<MethodChoice>& choice, const FieldProgress& progress);

// Of the render that is under way in a folder, of the samples that are kept there or else of its run.json. Throws InputError if
// none of them is there.
RequestOnDisk request_in(const std::filesystem::path& folder);
// Of such a file.
RequestOnDisk request_in_file(const std::filesystem::path& file);
// The file of what is under way or kept there, if any.
std::optional<std::filesystem::path> saved_render_in(const std::filesystem::path& folder);

// Throws InputError ("out/x/render.unfinished: damaged: …") if it is not whole, and if another version of the program wrote it.
RenderState read_saved_render(const std::filesystem::path& file);

}  // namespace neumann
