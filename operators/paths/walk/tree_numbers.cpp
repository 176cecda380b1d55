#include "operators/paths/walk/tree_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace neumann {

namespace {

enum class Change { stays, splits, thins };

// The best numbers if depths change in this way; empty if the closed form changes them in another way.
std::vector<double> numbers_of(const TreeMoments& tree, std::span<const Change> changes) {
    const std::size_t n = tree.depths();
    std::vector<double> numbers(n, 1.0);
    double before = 0.0;
    for (std::size_t begin = 0, end; begin < n; begin = end) {
        for (end = begin + 1; end < n && changes[end] == Change::stays; ++end) {
        }
        double variance = 0.0, cost = 0.0;
        for (std::size_t j = begin; j < end; ++j) {
            variance += tree.variance[j];
            cost += tree.cost[j];
        }
        if (changes[begin] == Change::thins) variance += tree.remainder[begin];
        if (end < n && changes[end] == Change::thins) variance -= tree.remainder[end];
        const double number = std::sqrt(variance / cost);
        const bool fits = begin == 0 || (changes[begin] == Change::splits ? number >= before : number <= before);
        if (!(number > 0.0) || !std::isfinite(number) || !fits) return {};
        std::fill(numbers.begin() + static_cast<std::ptrdiff_t>(begin), numbers.begin() + static_cast<std::ptrdiff_t>(end), number);
        before = number;
    }
    const double first = numbers[0];
    for (double& m : numbers) m /= first;
    return numbers;
}

}  // namespace

double work_of(const TreeMoments& tree, std::span<const double> numbers) {
    double variance = 0.0, cost = 0.0;
    for (std::size_t j = 0; j < tree.depths(); ++j) {
        variance += tree.variance[j] / numbers[j];
        if (j > 0 && numbers[j] < numbers[j - 1]) variance += tree.remainder[j] * (1.0 / numbers[j] - 1.0 / numbers[j - 1]);
        cost += tree.cost[j] * numbers[j];
    }
    return variance * cost;
}

std::vector<double> best_tree(const TreeMoments& tree) {
    const std::size_t n = tree.depths();
    if (n == 0 || n > 10) throw std::logic_error("best_tree: expected 1 to 10 depths");
    std::vector<double> best(n, 1.0);
    double least = work_of(tree, best);
    std::vector<Change> changes(n, Change::stays);
    for (;;) {
        const std::vector<double> numbers = numbers_of(tree, changes);
        if (!numbers.empty())
            if (const double work = work_of(tree, numbers); work < least) {
                least = work;
                best = numbers;
            }
        // Takes the next choice by counting in threes from depth 1 on.
        std::size_t j = 1;
        for (; j < n && changes[j] == Change::thins; ++j) changes[j] = Change::stays;
        if (j >= n) return best;
        changes[j] = changes[j] == Change::stays ? Change::splits : Change::thins;
    }
}

double walks_of_tree(std::span<const double> ratios, std::span<const double> cost) {
    double number = 1.0, tree = 0.0, walk = 0.0;
    for (std::size_t j = 0; j < cost.size(); ++j) {
        if (j > 0 && j <= ratios.size()) number *= ratios[j - 1];
        tree += number * cost[j];
        walk += cost[j];
    }
    return walk > 0.0 ? tree / walk : 1.0;
}

}  // namespace neumann
