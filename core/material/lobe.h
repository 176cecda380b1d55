// How sharply a material reflects, for code that has to resolve directions.
#pragma once

namespace neumann {

struct Lobe {
    // `diffuse`: fs does not depend on directions. `rough`: a highlight whose slopes spread by α. `specular`: fs has a delta, which
    // eval() and pdf() cannot show: of it they say 0, and only sample() reflects.
    enum class Kind { diffuse, rough, specular };
    Kind kind = Kind::diffuse;
    double alpha = 1.0;  // 0 where specular, 1 where diffuse
};

}  // namespace neumann
