// Gives out names of objects and files, each once.
#pragma once

#include <map>
#include <set>
#include <string>

namespace neumann::reader {

class Names {
public:
    // The wished name without characters that files and Mitsuba's ids may not have, such as a full stop, and with a
    // number if it is taken.
    std::string unique(const std::string& wished);

private:
    std::set<std::string> taken_;
    std::map<std::string, int> numbers_;  // the last number of each name
};

}  // namespace neumann::reader
