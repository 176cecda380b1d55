// What a study is asked for.
#pragma once

#include "operators/study/own_estimator.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

class Crew;

struct StudyRequest {
    std::string scene;
    std::vector<std::string> definition_texts;
    bool lenient = false;
    std::map<std::string, std::string> definitions;
    std::string output;
    std::vector<std::string> methods;  // as read_method() reads them, or of `own`; empty: all that can do the scene
    std::map<std::string, OwnEstimator> own = {};

}  // namespace neumann
