#include "operators/render/methods/prepared.h"

namespace neumann {

std::shared_ptr<const PathMethod> Prepared::of(const std::string& method) const {
    const auto found = made_.find(method);
    return found == made_.end() ? nullptr : found->second;
}

std::shared_ptr<const PathMethod> Prepared::keep(const std::string& method, std::shared_ptr<const PathMethod> made) {
    return made_[method] = std::move(made);
}

void Prepared::keep_only(const std::string& method) {
    std::erase_if(made_, [&](const auto& kept) { return kept.first != method; });
}

}  // namespace neumann
