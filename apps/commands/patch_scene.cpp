#include "apps/commands/patch_scene.h"

#include "apps/commands/print_warnings.h"
#include "apps/output/files/checkpoints.h"
#include "apps/output/files/row_files.h"
#include "apps/output/files/scene_json.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/limits.h"
#include "core/geometry/ray_caster.h"
#include "core/scene/normal_maps.h"
#include "operators/fields/shared/shared_system.h"

#include <fmt/format.h>
#include <cmath>
#include <cstdio>
#include <exception>

namespace neumann {

namespace {

constexpr const char* letters[] = {"r", "g", "b"};  // names of the channels

TracedSettings settings(const PatchOptions& options) {
    return {options.patches, options.rays, options.seed, memory_limit(options.memory)};
}

std::shared_ptr<const Scene> read_interruptibly(const SceneFile& file) {
    const EndsAtInterrupts reading;
    return std::make_shared<const Scene>(read_scene(file));
}

// Opens the folder of rows; throws on all processes if one cannot use it.
std::unique_ptr<RowFiles> open_rows(const PatchOptions& options, const Scene& scene, Processes* processes) {
    std::unique_ptr<RowFiles> rows;
    std::exception_ptr wrong;
    try {
        rows = std::make_unique<RowFiles>(
            *options.keep,
            nlohmann::ordered_json{
                {"hash", scene.hash}, {"definitions", options.scene.definitions}, {"lenient", options.scene.lenient}},
            processes ? processes->rank() : 0, options.checkpoint.value_or(default_checkpoint));
    } catch (const InputError&) {
        wrong = std::current_exception();
    }
    double one_is_wrong[] = {wrong ? 1.0 : 0.0};
    if (processes) processes->largest(one_is_wrong);
    if (wrong) std::rethrow_exception(wrong);
    if (one_is_wrong[0] > 0.0) throw OptionError("keep", fmt::format("{}: another process cannot use this folder", *options.keep));
    return rows;
}

}  // namespace

PatchScene::PatchScene(const PatchOptions& options) : PatchScene(options, read_interruptibly(options.scene)) {}

PatchScene::PatchScene(const PatchOptions& options, std::shared_ptr<const Scene> scene)
    : PatchScene(options, scene, nullptr, [&](const TracedSettings& traced) {
          return std::make_unique<TracedSystem>(*scene, traced, Watch{.stop = interrupted});
      }) {}

PatchScene::PatchScene(const PatchOptions& options, Processes& processes, const std::string& petsc)
    : PatchScene(options, read_interruptibly(options.scene), &processes, [&](const TracedSettings& traced) {
          return std::make_unique<SharedSystem>(*scene_, traced, processes, petsc, Watch{.stop = interrupted});
      }) {}

PatchScene::PatchScene(const PatchOptions& options, std::shared_ptr<const Scene> scene, Processes* processes,
                       const std::function<std::unique_ptr<MatrixSystem>(const TracedSettings&)>& make)
    : options_(options), threads_(options.threads), scene_(std::move(scene)) {
    TracedSettings traced = settings(options);
    // The folder is released as soon as T is traced, so that others may use it.
    const auto rows = options.keep ? open_rows(options, *scene_, processes) : nullptr;
    traced.store = rows.get();
    try {
        system_ = make(traced);
    } catch (const Stopped&) {
        if (!rows) throw;
        throw Stopped(fmt::format("interrupted; the rays that were traced are in {}, and the same command goes on from there",
                                  *options.keep));
    } catch (const KeptRowsError&) {
        throw;
    } catch (const InputError& e) {
        throw InputError(options.scene.path + ": " + e.what());
    }
}

const char* PatchScene::channel_letter(int c) const { return system_->channels() == 1 ? "" : letters[c]; }

std::vector<std::string> PatchScene::warnings() const {
    Warnings all = scene_->warnings;
    if (has_normal_maps(*scene_)) all.add(patches_are_flat);
    return texts(all);
}

std::string PatchScene::title() const {
    return fmt::format("{}: {} patches, {} unknowns, {} rays each, seed {}", options_.scene.path, system_->space().patches().size(),
                       system_->space().size(), options_.rays, options_.seed);
}

nlohmann::ordered_json PatchScene::json() const {
    nlohmann::ordered_json json;
    json["program"] = {{"name", "neumann"}, {"version", NEUMANN_VERSION}, {"ray_caster", embree_version()}};
    json["command"] = options_.command_line;
    json["scene"] = scene_json(*scene_, options_.scene);
    json["options"] = {{"patches", options_.patches}, {"directions", options_.rays}, {"seed", options_.seed}};
    json["patches"] = system_->space().patches().size();
    json["unknowns"] = system_->space().size();
    json["rays"] = system_->rays();
    return json;
}

std::optional<int> channel_number(const std::string& name) {
    for (int c = 0; c < 3; ++c)
        if (name == letters[c]) return c;
    return std::nullopt;
}

}  // namespace neumann
