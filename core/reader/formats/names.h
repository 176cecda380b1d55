// Names of objects and files, each given once.
#pragma once

#include <map>
#include <set>
#include <string>

namespace neumann::reader {

class Names {
public:
    // The wished name without what files and Mitsuba's ids may not have (a full stop, for one), and with a number if it is taken.
    std::string unique(const std::string& wished);

private:
    std::set<std::string> taken_;
    std::map<std::string, int> numbers_;  // the last of each name
};

}  // namespace neumann::reader
