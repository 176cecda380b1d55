#include "apps/processes/helper.h"

#include "apps/output/files/json_text.h"
#include "apps/processes/launch.h"
#include "apps/processes/render_message.h"
#include "apps/processes/share_message.h"
#include "apps/processes/together.h"
#include "core/base/interrupt.h"
#include "core/base/limits.h"
#include "operators/render/from_fields/field_rendering.h"
#include "operators/render/from_paths/share_queue.h"
#include "operators/render/methods/method_plan.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstring>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

// The interval at which messages are looked for, which takes time from the thread that samples. It has the next share by then.
constexpr std::chrono::milliseconds moment(2);

class Helper {
public:
    explicit Helper(Processes& processes) : processes_(processes) {}

    void run() {
        while (!is_over_) {
            bool waits = true;
            while (const auto message = processes_.receive()) {
                waits = false;
                try {
                    handle(Json::parse(message->text), message->numbers);
                } catch (const std::exception& e) {
                    fail(e);
                }
            }
            waits = !answer() && waits;
            if (waits) std::this_thread::sleep_for(moment);
        }
    }

private:
    void handle(const Json& message, std::span<const std::byte> numbers) {
        const auto what = message.at("do").get<std::string>();
        if (what == "render") {
            begin(render_message_from(message));
            send({{"ready", message.at("number")}});
        } else if (what == "share" && shares_) {
            Tally outdo(numbers.size() / sizeof(double));
            for (std::size_t q = 0; q < outdo.largest.size(); ++q) {
                double threshold = 0.0;
                std::memcpy(&threshold, numbers.data() + q * sizeof threshold, sizeof threshold);
                outdo.largest[q].outdo(threshold);
            }
            number_ = message.at("number");
            shares_->add(share_from(message.at("share")), outdo);
        } else if (what == "fields") {
            // The first process does not wait for a reply.
            try {
                begin_fields(render_message_from(message));
            } catch (const std::exception& e) {
                end_all(processes_, e);
            }
        } else if (what == "render fields") {
            render_share_of(numbers);
        } else if (what == "drop" && shares_) {
            shares_->drop();
        } else if (what == "end") {
            shares_.reset();
            send({{"ended", true}});
            is_over_ = true;
        }
    }

    void begin(const RenderMessage& message) {
        prepare(message);
        samples_.emplace(*scene_, message.render, message.colors);
        shares_.emplace(samples_->sampler());
    }

    void begin_fields(const RenderMessage& message) {
        prepare(message);
        if (auto reduced = without_unlit_materials(plan_for(message.render.method, *scene_), *scene_))
            without_unlit_.emplace(std::move(*reduced));
    }

    void prepare(const RenderMessage& message) {
        shares_.reset();
        samples_.reset();
        without_unlit_.reset();
        threads_.reset();
        threads_.emplace(threads_of_process(message.threads));
        if (!scene_ || message.scene != on_disk_) {
            scene_.emplace(read(message.scene));
            on_disk_ = message.scene;
        }
    }

    void render_share_of(std::span<const std::byte> settings) {
        try {
            together(processes_, [&] {
                return render_fields(without_unlit_ ? *without_unlit_ : *scene_, field_settings_from(settings), {}, &processes_);
            });
        } catch (const InputError&) {
            // The first process finds this error, too.
        }
    }

    // Sends the sampled shares; returns whether there were any.
    bool answer() {
        bool did = false;
        try {
            while (auto done = shares_ ? shares_->take() : std::nullopt) {
                send({{"sampled", number_}, {"share", as_json(done->first)}}, as_bytes(done->second));
                did = true;
            }
        } catch (const std::exception& e) {
            fail(e);
            shares_.reset();
        }
        return did;
    }

    void fail(const std::exception& e) { send({{"failed", e.what()}, {"machine", processes_.machine()}}); }
    void send(const Json& text, const std::vector<std::byte>& numbers = {}) { processes_.send(0, json_text(text), {numbers}); }

    Processes& processes_;
    std::optional<ThreadLimit> threads_;
    SceneOnDisk on_disk_;
    std::optional<Scene> scene_;
    std::optional<Scene> without_unlit_;  // the scene for fields, if it is a different one
    std::optional<RecordedSamples> samples_;
    std::optional<ShareQueue> shares_;
    std::uint64_t number_ = 0;  // number of the work to which the shares belong
    bool is_over_ = false;
};

}  // namespace

int help(Processes& processes) {
    // Interrupts may be sent to all processes; the first one then ends the render, and this process.
    ignore_interrupts();
    Helper(processes).run();
    return 0;
}

}  // namespace neumann
