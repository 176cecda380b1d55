// The smallest scene that still fails.
#pragma once

#include <pugixml.hpp>

#include <functional>

namespace neumann::search {

// Takes elements away, puts what is inside of them in their place and rounds numbers, as long as `fails` says yes, until nothing
// more can go or `stop` says so.
void shrink(pugi::xml_document& scene, const std::function<bool(const pugi::xml_document&)>& fails,
            const std::function<bool()>& stop);

}  // namespace neumann::search
