// Rows of T in a folder, so that no ray is traced twice: neither those traced before a process died, nor those that
// another command on the same scene needs. rows_PPP_NNNNN.kept is the N-th file of process P (state_file.h): some
// facets of one table and their rows. Files are only ever added.
#pragma once

#include "apps/output/files/output_folder.h"
#include "operators/fields/matrix/matrix_system.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>

namespace neumann {

class RowFiles : public RowStore {
public:
    // `scene`: everything on which the rays depend besides the numbers of patches and rays and the seed. `rank`: the rank of this
    // process among those that keep rows there together; the first locks the folder. `seconds`: the least time from one file to the
    // next. Throws InputError as OutputFolder does, and if there are rows of another scene or version, or an incomplete file.
    RowFiles(const std::filesystem::path& folder, nlohmann::ordered_json scene, int rank, double seconds);

    // The result refers to this object.
    std::unique_ptr<KeptRows> rows_of(const TracedSettings& settings) override;

private:
    class Kept;

    OutputFolder folder_;
    nlohmann::ordered_json scene_;
    int rank_, next_ = 0;
    double seconds_;
};

}  // namespace neumann
