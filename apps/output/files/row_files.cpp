#include "apps/output/files/row_files.h"

#include "apps/output/files/json_text.h"
#include "apps/output/files/state_file.h"
#include "core/base/error.h"
#include "core/base/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace neumann {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".kept" && is_output_name(entry.path().filename().string())) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

void expect_same_scene(const fs::path& folder, const Json& now, const Json& kept) {
    for (const auto& [name, value] : now.items()) {
        const Json before = kept.value(name, Json());
        if (value != before)
            throw OptionError(
                "keep", fmt::format("{}: holds rays of another scene: its {} is {} there, and {} here; expected another folder",
                                    folder.string(), name, json_text(before), json_text(value)));
    }
}

Json table_of(const TracedSettings& settings) {
    return {{"patches", settings.patches}, {"directions", settings.rays}, {"seed", settings.seed}};
}

}  // namespace

class RowFiles::Kept : public KeptRows {
public:
    Kept(RowFiles& files, Json table) : files_(files), table_(std::move(table)) {}

    void read(const std::function<bool(std::span<const std::uint32_t>, std::span<const std::uint32_t>)>& take) override {
        for (const fs::path& path : files_in(files_.folder_.path())) {
            try {
                StateFile file(path);
                const Json& header = file.header();
                if (header.at("table") != table_) continue;
                const auto facets = file.numbers<std::uint32_t>(header.at("facets")),
                           seen = file.numbers<std::uint32_t>(header.at("rays"));
                file.expect_end();
                if (!take(facets, seen)) file.damaged("its rows are of other patches");
            } catch (const InputError& e) {
                throw KeptRowsError(std::string(e.what()) + "; without that file its rays are traced again");
            }
        }
    }

    bool is_due() const override { return since_last_.seconds() >= files_.seconds_; }

    void keep(std::span<const std::uint32_t> facets, const std::vector<std::span<const std::uint32_t>>& seen) override {
        std::vector<std::string_view> numbers{bytes_of(facets.data(), facets.size())};
        std::size_t rays = 0;
        for (const auto& piece : seen) {
            numbers.push_back(bytes_of(piece.data(), piece.size()));
            rays += piece.size();
        }
        const std::string name = fmt::format("rows_{:03}_{:05}.kept", files_.rank_, files_.next_);
        try {
            write_state({{"scene", files_.scene_}, {"table", table_}, {"facets", facets.size()}, {"rays", rays}},
                        std::move(numbers),
                        [&](std::span<const std::string_view> pieces) { files_.folder_.put_at_once(name, pieces); });
        } catch (const RunError& e) {
            throw RunError(std::string(e.what()) + "\nWhat was kept before is whole: the same command goes on from there");
        }
        ++files_.next_;
        since_last_ = Stopwatch();
    }

private:
    RowFiles& files_;
    Json table_;
    Stopwatch since_last_;
};

RowFiles::RowFiles(const fs::path& folder, Json scene, int rank, double seconds)
    : folder_(folder, "--keep", rank == 0), scene_(std::move(scene)), rank_(rank), seconds_(seconds) {
    const std::string own = fmt::format("rows_{:03}_", rank);
    for (const fs::path& path : files_in(folder)) {
        try {
            expect_same_scene(folder, scene_, StateFile(path).header().at("scene"));
        } catch (const Json::exception&) {
            throw InputError(path.string() + ": is no file of rays; expected another folder with --keep");
        }
        const std::string name = path.stem();
        if (name.starts_with(own)) next_ = std::max(next_, std::stoi(name.substr(own.size())) + 1);
    }
}

std::unique_ptr<KeptRows> RowFiles::rows_of(const TracedSettings& settings) {
    return std::make_unique<Kept>(*this, table_of(settings));
}

}  // namespace neumann
