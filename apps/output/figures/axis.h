// The axis of a plot: where values are, and which of them are written.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace neumann {

struct Tick {
    double value;
    std::string label;  // empty: a short stroke
};

class Axis {
public:
    // Logarithmic axes hold the range with some space, and at least a factor of 4; linear ones whole numbers from 0.
    static Axis logarithmic(double least, double most);
    static Axis of_whole_numbers(double most);

    // The place from 0 to 1; beyond these outside of the axis.
    double place(double value) const;
    // At most about one label for `space` of a whole of 1.
    std::vector<Tick> ticks(double space) const;

private:
    Axis(bool is_logarithmic, double low, double high) : is_logarithmic_(is_logarithmic), low_(low), high_(high) {}
    std::vector<Tick> decades(double space) const;

    bool is_logarithmic_;
    double low_, high_;  // or their logarithms
};

}  // namespace neumann
