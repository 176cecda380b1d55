#include "apps/output/files/state_file.h"

#include "apps/output/files/json_text.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/geometry/ray_caster.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fmt/format.h>

#include <bit>
#include <ranges>
#include <system_error>
#include <utility>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "numbers are written as they are in memory");
constexpr std::string_view magic = "neumann state 3\n";

std::string program() { return fmt::format("{}, {}", NEUMANN_VERSION, embree_version()); }

}  // namespace

class StateHash {
public:
    StateHash() { XXH3_64bits_reset(state_.get()); }
    void add(const void* bytes, std::size_t size) { XXH3_64bits_update(state_.get(), bytes, size); }
    std::uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

private:
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_{XXH3_createState(), XXH3_freeState};
};

void write_state(Json header, std::vector<std::string_view> pieces,
                 const std::function<void(std::span<const std::string_view>)>& write) {
    header["program"] = program();
    const std::string text = json_text(header);
    const std::uint64_t size = text.size();
    std::vector<std::string_view> head = {magic, bytes_of(&size, 1), text};
    StateHash hash;
    for (const std::string_view piece : head) hash.add(piece.data(), piece.size());
    const std::uint64_t of_head = hash.value();
    head.push_back(bytes_of(&of_head, 1));
    pieces.insert(pieces.begin(), head.begin(), head.end());
    for (const std::string_view piece : pieces | std::views::drop(3)) hash.add(piece.data(), piece.size());
    const std::uint64_t of_all = hash.value();
    pieces.push_back(bytes_of(&of_all, 1));
    write(pieces);
}

void write_state(OutputFolder& folder, Json header, std::vector<std::string_view> numbers) {
    write_state(std::move(header), std::move(numbers), [&](std::span<const std::string_view> pieces) { folder.save(pieces); });
}

StateFile::StateFile(const std::filesystem::path& path)
    : path_(path), file_(open_if_there(path)), hash_(std::make_unique<StateHash>()) {
    if (!file_) throw InputError(path.string() + ": cannot be read");
    std::error_code error;
    left_ = std::filesystem::file_size(path, error);
    std::string start(magic.size(), '\0');
    read(start.data(), start.size());
    if (start != magic) damaged("it does not begin as such files do");
    const std::uint64_t size = numbers<std::uint64_t>(1).front();
    const std::vector<char> text = numbers<char>(size);
    expect_hash();
    try {
        header_ = Json::parse(text.begin(), text.end());
        const auto version = header_.at("program").get<std::string>();
        if (version != program())
            throw InputError(fmt::format("{}: was written by version {}, and this is {}, whose rays may be others", path.string(),
                                         version, program()));
    } catch (const Json::exception& e) {
        damaged(e.what());
    }
}

StateFile::~StateFile() = default;

void StateFile::read(void* to, std::size_t bytes) {
    if (bytes > left_) damaged("it ends too early");
    left_ -= bytes;
    if (!file_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))) damaged("it ends too early");
    hash_->add(to, bytes);
}

void StateFile::expect_hash() {
    const std::uint64_t expected = hash_->value();
    if (numbers<std::uint64_t>(1).front() != expected) damaged("its checksum is another");
}

void StateFile::expect_end() {
    expect_hash();
    if (left_ != 0) damaged("something follows its end");
}

void StateFile::damaged(const std::string& why) const { throw InputError(fmt::format("{}: damaged: {}", path_.string(), why)); }

}  // namespace neumann
