#include "apps/processes/process_crew.h"

#include "apps/output/files/json_text.h"
#include "apps/processes/render_message.h"
#include "apps/processes/share_message.h"
#include "apps/processes/together.h"
#include "core/base/error.h"
#include "operators/render/from_fields/field_rendering.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

// The number of shares that a process has at once: the one being sampled and the next.
constexpr int shares_each = 2;

class ProcessHelpers : public Helpers {
public:
    ProcessHelpers(Processes& processes, Json render, std::uint64_t& number)
        : processes_(processes), helpers_(static_cast<std::size_t>(processes.size())), number_(number), begun_(++number) {
        render["do"] = "render";
        render["number"] = number_;
        tell(render);
    }
    ~ProcessHelpers() override { drop(); }

    int count() const override { return processes_.size() - 1; }

    bool give(const Share& share, const Tally& tally) override {
        int to = 0;
        for (int rank = 1; rank < processes_.size(); ++rank)
            if (of(rank).is_ready && of(rank).shares < (to > 0 ? of(to).shares : shares_each)) to = rank;
        if (to == 0) return false;
        std::vector<double> outdo;
        for (const LargestSamples& largest : tally.largest) outdo.push_back(largest.threshold());
        processes_.send(to, json_text(Json{{"do", "share"}, {"number", number_}, {"share", as_json(share)}}),
                        {std::as_bytes(std::span(outdo))});
        ++of(to).shares;
        return true;
    }

    std::optional<std::pair<Share, SampledShare>> take() override {
        while (auto message = processes_.receive()) {
            const Json text = Json::parse(message->text);
            Helper& helper = of(message->from);
            if (text.contains("failed"))
                throw RunError(fmt::format("process {} on {}: {}", message->from, text.at("machine").get<std::string>(),
                                           text.at("failed").get<std::string>()));
            if (text.contains("ready") && text.at("ready") == begun_) helper.is_ready = true;
            if (!text.contains("sampled") || text.at("sampled") != number_) continue;
            --helper.shares;
            return std::pair(share_from(text.at("share")), sampled_share_from(message->numbers));
        }
        return std::nullopt;
    }

    void drop() override {
        ++number_;
        tell({{"do", "drop"}});
        for (Helper& helper : helpers_) helper.shares = 0;
    }

private:
    struct Helper {
        bool is_ready = false;
        int shares = 0;
    };
    void tell(const Json& all) {
        for (int rank = 1; rank < processes_.size(); ++rank) processes_.send(rank, json_text(all));
    }
    Helper& of(int rank) { return helpers_[static_cast<std::size_t>(rank)]; }

    Processes& processes_;
    std::vector<Helper> helpers_;
    std::uint64_t& number_;
    std::uint64_t begun_;
};

class ProcessTeam : public FieldTeam {
public:
    ProcessTeam(Processes& processes, Json fields) : processes_(processes) {
        fields["do"] = "fields";
        tell(fields);
    }

    int on_this_machine() const override { return processes_.on_this_machine(); }
    std::optional<FieldPictures> render(const Scene& scene, const FieldSettings& settings, const Watch& watch,
                                        FieldSaving* saving) override {
        tell({{"do", "render fields"}}, as_bytes(settings));
        return together(processes_, [&] { return render_fields(scene, settings, watch, &processes_, saving); });
    }

private:
    void tell(const Json& all, std::span<const std::byte> numbers = {}) {
        for (int rank = 1; rank < processes_.size(); ++rank) processes_.send(rank, json_text(all), {numbers});
    }

    Processes& processes_;
};

}  // namespace

std::unique_ptr<Helpers> ProcessCrew::begin(const RecordedRender& render, const std::optional<glm::dmat3>& colors) {
    return std::make_unique<ProcessHelpers>(processes_, as_json(RenderMessage{scene_, threads_, render, colors}), number_);
}

std::unique_ptr<FieldTeam> ProcessCrew::begin_fields(const Method& method) {
    RenderMessage message{scene_, threads_, {}, {}};
    message.render.method = method;
    return std::make_unique<ProcessTeam>(processes_, as_json(message));
}

}  // namespace neumann
