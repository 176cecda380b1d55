// How sharply a material reflects, for code that has to resolve directions.
#pragma once

namespace neumann {

struct Lobe {
    // `diffuse`: fs does not depend on directions. `rough`: a glossy lobe of roughness α. `specular`: fs has a delta lobe, which
    // eval() and pdf() do not include; only sample() returns it.
    enum class Kind { diffuse, rough, specular };
    Kind kind = Kind::diffuse;
    double alpha = 1.0;  // 0 if specular, 1 if diffuse
};

}  // namespace neumann
