// An unfinished render on disk, which another process can continue (state_file.h). The numbers are moments, ranges of
// samples and errors by samples; or fields and the pixels that were read from them (saved_fields.h).
#pragma once

#include "apps/output/files/output_folder.h"
#include "operators/render/methods/saving.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace neumann {

struct RequestOnDisk {
    nlohmann::ordered_json request;  // the options of a render (request_json.h)
    std::string scene_hash;
};

void save_render(OutputFolder& folder, const RequestOnDisk& request, const RecordedRender& render,
                 const std::optional<MethodChoice>& choice, const RenderedSeries& series);

void save_fields(OutputFolder& folder, const RequestOnDisk& request, const RecordedRender& render,
                 const std::optional<MethodChoice>& choice, const FieldProgress& progress);

// The request of the unfinished render in a folder, of the samples kept there, or else from its run.json. Throws
// InputError if none of them exists.
RequestOnDisk request_in(const std::filesystem::path& folder);
RequestOnDisk request_in_file(const std::filesystem::path& file);
// The file of the unfinished render or of the kept samples, if any.
std::optional<std::filesystem::path> saved_render_in(const std::filesystem::path& folder);

// Reads a state. Throws InputError ("out/x/render.unfinished: damaged: …") if it is not complete, and if another
// version of the program wrote it.
RenderState read_saved_render(const std::filesystem::path& file);

}  // namespace neumann
