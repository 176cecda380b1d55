// The forms in which `neumann spectrum` prints its report: tables of at most 100 columns, CSV, JSON.
#include "apps/commands/spectrum_print.h"

#include "apps/output/files/json_number.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>

namespace neumann {

namespace {

constexpr int label_width = 30, cell_width = 20;

std::string complex_text(const std::complex<double>& z, int digits = 6) {
    if (z.imag() == 0.0) return fmt::format("{:.{}f}", z.real(), digits);
    return fmt::format("{:.{}f}{}{:.{}f}i", z.real(), digits, z.imag() < 0.0 ? "-" : "+", std::abs(z.imag()), digits);
}

void print_row(const std::string& label, const SceneSpectrum& report,
               const std::function<std::string(const ChannelSpectrum&)>& cell) {
    std::string line = fmt::format("{:<{}}", label, label_width);
    for (const ChannelSpectrum& s : report.channels) line += fmt::format("{:>{}}", cell(s), cell_width);
    fmt::print("{}\n", line);
}

void print_transport(const SceneSpectrum& report) {
    fmt::print("T (in a closed scene all rows sum to 1, and no ray sees nothing)\n");
    fmt::print("{:<30}{:>10.6f}{:>10.6f}{:>10.6f}   smallest, mean, largest\n", "  row sums", report.row_min, report.row_mean,
               report.row_max);
    fmt::print("{:<30}{:>8.2f} %   or a side that neither reflects nor shines\n", "  rays that see nothing",
               100.0 * report.rays_without_hit);
    fmt::print("{:<30}{:>10.1e}   statistical: T is traced, the functions are random\n", "  reciprocity defect",
               report.reciprocity_defect);
}

void print_norms(const SceneSpectrum& report) {
    const auto fixed = [](double x) { return std::isfinite(x) ? fmt::format("{:.6f}", x) : "not found"; };
    print_row("K", report, [](const ChannelSpectrum& s) { return s.name; });
    print_row("  largest albedo", report, [&](const ChannelSpectrum& s) { return fixed(s.largest_albedo); });
    print_row("  ‖K‖∞, of radiance", report, [&](const ChannelSpectrum& s) { return fixed(s.norms.sup); });
    print_row("  ‖K‖₁, of power", report, [&](const ChannelSpectrum& s) { return fixed(s.norms.one); });
    print_row("    standard error by the rays", report,
              [](const ChannelSpectrum& s) { return fmt::format("{:.2g}", s.one.error); });
    print_row("    there, part of the measure", report, [](const ChannelSpectrum& s) { return fmt::format("{:.1e}", s.one.part); });
    print_row("  ‖K‖₂", report, [&](const ChannelSpectrum& s) { return fixed(s.norms.two); });
    print_row("  spectral radius", report, [&](const ChannelSpectrum& s) { return fixed(s.radius); });
    print_row("    moves on refinement by", report,
              [](const ChannelSpectrum& s) { return std::isfinite(s.shift) ? fmt::format("{:.1e}", s.shift) : "unknown"; });
    print_row("  the series", report, [](const ChannelSpectrum& s) { return std::string(name(s.convergence)); });
    fmt::print(
        "‖L‖∞ = max |L|, ‖L‖₁ = Σ m |L|, ‖L‖₂ = (Σ m L²)^½, with m = n² · area · projected solid angle, the\n"
        "measure of an unknown: ‖K‖₁ is the largest part of an unknown's power that a bounce leaves. The\n"
        "largest albedo bounds all three of K itself. Of this matrix ‖K‖₁ and ‖K‖₂ can exceed it, by noise of\n"
        "the rays: few meet a small patch, and ‖K‖₁ is that of the patch that had the most luck.\n");
    for (const ChannelSpectrum& s : report.channels) {
        if (s.convergence == Convergence::diverges)
            fmt::print("{}: diverges, the spectral radius is {:.6f}: K^i Le grows without end.\n", s.name, s.radius);
        if (s.convergence == Convergence::at_one)
            fmt::print("{}: does not converge (albedo 1 in a closed room): the spectral radius is 1, no light is lost.\n", s.name);
        if (s.convergence == Convergence::undecided && s.shift > 0.0)
            fmt::print("{}: undecided, the spectral radius is as near to 1 as it moves with the mesh or the rays, {:.1e}.\n",
                       s.name, s.shift);
    }
}

// Prints the results of SLEPc: the moduli, and their distance from ours.
void print_slepc(const SceneSpectrum& report) {
    const auto by_slepc = [](const ChannelSpectrum& s) { return s.by_slepc ? s.by_slepc->pairs.size() : 0; };
    std::size_t most = 0;
    for (const ChannelSpectrum& s : report.channels) most = std::max(most, by_slepc(s));
    for (std::size_t i = 0; i < most; ++i)
        print_row(fmt::format("  {}, SLEPc", i + 1), report, [&](const ChannelSpectrum& s) {
            return i < by_slepc(s) ? complex_text(s.by_slepc->pairs[i].value) : std::string("not found");
        });
    if (most > 0)
        print_row("  applications of K, both", report, [](const ChannelSpectrum& s) {
            return fmt::format("{:.0f}, {:.0f}", s.leading.applications, s.by_slepc ? s.by_slepc->applications : 0.0);
        });
    for (const ChannelSpectrum& s : report.channels)
        if (s.by_slepc && !s.by_slepc->converged) fmt::print("{}: {}.\n", s.name, s.by_slepc->why);
}

void print_eigenvalues(const SceneSpectrum& report) {
    print_row("Leading eigenvalues", report, [](const ChannelSpectrum& s) { return s.name; });
    std::size_t most = 0;
    for (const ChannelSpectrum& s : report.channels) most = std::max(most, s.leading.pairs.size());
    for (std::size_t i = 0; i < most; ++i) {
        const auto cell = [&](const auto& text) {
            return [&, i](const ChannelSpectrum& s) { return i < s.leading.pairs.size() ? text(s.leading.pairs[i]) : ""; };
        };
        print_row(fmt::format("  {}", i + 1), report, cell([](const Eigenpair& pair) {
                      const bool found = pair.residual <= 1e-8 * std::max(std::abs(pair.value), 1e-8);
                      return found ? complex_text(pair.value) : "≈ " + complex_text(pair.value, 3);
                  }));
    }
    print_row("  largest residual", report, [](const ChannelSpectrum& s) {
        double largest = 0.0;
        for (const Eigenpair& pair : s.leading.pairs) largest = std::max(largest, pair.residual);
        return s.leading.converged ? fmt::format("{:.1e}", largest) : fmt::format("not found: {:.0e}", largest);
    });
    print_slepc(report);
    for (const ChannelSpectrum& s : report.channels) {
        if (!s.leading.converged) fmt::print("{}: {}.\n", s.name, s.leading.why);
        if (s.bounds && s.bounds->meet())
            fmt::print("{}: the radius is known without them: some light is kept for good, {:.6f} of it each time.\n", s.name,
                       s.radius);
        else if (s.bounds)
            fmt::print("{}: the radius is between {:.6f} and {:.6f}.\n", s.name, s.bounds->low, s.bounds->high);
    }
}

void print_refinement(const PatchScene& scene, const SceneSpectrum& report) {
    const auto width = 10 * report.channels.size();
    fmt::print("{:<14}{:>8}{:>10}{:>6}{:>{}}{:>{}}\n", "Refinement", "patches", "unknowns", "rays", "|λ₁|", width, "|λ₂|", width);
    fmt::print("{:38}", "");
    for (int i = 0; i < 2; ++i)
        for (const ChannelSpectrum& s : report.channels) fmt::print("{:>10}", s.name);
    fmt::print("\n");
    const auto row = [&](const char* what, std::size_t patches, std::size_t unknowns, std::uint32_t rays, const auto& value) {
        fmt::print("{:<14}{:>8}{:>10}{:>6}", what, patches, unknowns, rays);
        for (std::size_t i = 0; i < 2; ++i)
            for (std::size_t c = 0; c < report.channels.size(); ++c) fmt::print("{:>10}", value(c, i));
        fmt::print("\n");
    };
    for (const RefinementRow& r : report.coarser)
        row(fmt::format("  {}", r.what).c_str(), r.patches, r.unknowns, r.settings.rays, [&](std::size_t c, std::size_t i) {
            if (i < r.leading[c].size()) return fmt::format("{:.5f}", std::abs(r.leading[c][i]));
            return std::string(r.leading[c].empty() ? "not found" : "");
        });
    row("  as above", scene.system().space().patches().size(), scene.system().space().size(), scene.system().settings().rays,
        [&](std::size_t c, std::size_t i) {
            const auto& pairs = report.channels[c].leading.pairs;
            return i < pairs.size() ? fmt::format("{:.5f}", std::abs(pairs[i].value)) : "";
        });
    fmt::print(
        "K of a scene with edges is not compact: beyond the first its eigenvalues belong to the mesh and the\n"
        "rays, and need not settle.\n");
}

void print_bounces(const SceneSpectrum& report) {
    print_row("Bounces until", report, [](const ChannelSpectrum& s) { return s.name; });
    for (std::size_t i = 0; i < SceneSpectrum::remaining.size(); ++i)
        print_row(fmt::format("  {:g} % of the power is left", 100.0 * SceneSpectrum::remaining[i]), report,
                  [&, i](const ChannelSpectrum& s) {
                      if (!report.emits) return std::string("no light");
                      if (s.convergence != Convergence::converges) return std::string("none");
                      if (s.bounces_stopped) return std::string("out of time");
                      return s.bounces[i] ? fmt::format("{}", *s.bounces[i]) : fmt::format("> {}", SceneSpectrum::most_bounces);
                  });
    const auto known = [](const ChannelSpectrum& s) { return s.convergence == Convergence::converges && s.radius > 0.0; };
    print_row("Rounding", report, [](const ChannelSpectrum& s) { return s.name; });
    constexpr const char* formats[] = {"float", "double"};
    for (std::size_t i = 0; i < 2; ++i) {
        print_row(fmt::format("  {}, relative error", formats[i]), report,
                  [&, i](const ChannelSpectrum& s) { return known(s) ? fmt::format("{:.1e}", s.rounding[i]) : "none"; });
        print_row(fmt::format("  {}, sum stops at", formats[i]), report,
                  [&, i](const ChannelSpectrum& s) { return known(s) ? fmt::format("{:.0f}", s.stagnation[i]) : "none"; });
    }
    fmt::print("Relative error: what rounding K alone does to L. A plain sum stops changing at about that bounce.\n");
}

}  // namespace

void print_spectrum(const PatchScene& scene, const SceneSpectrum& report) {
    fmt::print("{}\n\n", scene.title());
    print_transport(report);
    fmt::print("\n");
    print_norms(report);
    fmt::print("\n");
    print_eigenvalues(report);
    fmt::print("\n");
    print_refinement(scene, report);
    fmt::print("\n");
    print_bounces(report);
}

void print_spectrum_csv(const PatchScene& scene, const SceneSpectrum& report) {
    fmt::print("channel,patches,unknowns,rays,index,real,imaginary,modulus,residual\n");
    const auto row = [](const char* channel, std::size_t patches, std::size_t unknowns, std::uint32_t rays, std::size_t i,
                        std::complex<double> z, const std::string& residual) {
        fmt::print("{},{},{},{},{},{:.17g},{:.17g},{:.17g},{}\n", channel, patches, unknowns, rays, i + 1, z.real(), z.imag(),
                   std::abs(z), residual);
    };
    for (std::size_t c = 0; c < report.channels.size(); ++c) {
        for (const RefinementRow& r : report.coarser)
            for (std::size_t i = 0; i < r.leading[c].size(); ++i)
                row(report.channels[c].name, r.patches, r.unknowns, r.settings.rays, i, r.leading[c][i], "");
        const auto& pairs = report.channels[c].leading.pairs;
        for (std::size_t i = 0; i < pairs.size(); ++i)
            row(report.channels[c].name, scene.system().space().patches().size(), scene.system().space().size(),
                scene.system().settings().rays, i, pairs[i].value, fmt::format("{:.3g}", pairs[i].residual));
    }
}

nlohmann::ordered_json spectrum_json(const PatchScene& scene, const SceneSpectrum& report) {
    using Json = nlohmann::ordered_json;
    const auto complex_json = [](std::complex<double> z) { return Json{{"real", z.real()}, {"imaginary", z.imag()}}; };
    Json json = scene.json();
    json["transport"] = {{"row_sums", {{"min", report.row_min}, {"mean", report.row_mean}, {"max", report.row_max}}},
                         {"rays_that_see_nothing", report.rays_without_hit},
                         {"reciprocity_defect", report.reciprocity_defect},
                         {"reciprocity_note", "statistical: a traced T is reciprocal only on average"}};
    json["norms_of"] = {{"inf", "radiance: max |L|"},
                        {"1", "power: sum of m |L|, m = n^2 * area * projected solid angle of an unknown"},
                        {"2", "root of the sum of m L^2"}};
    json["channels"] = Json::array();
    for (std::size_t c = 0; c < report.channels.size(); ++c) {
        const ChannelSpectrum& s = report.channels[c];
        Json channel = {
            {"name", s.name},
            {"largest_albedo", s.largest_albedo},
            {"norms", {{"inf", json_number(s.norms.sup)}, {"1", json_number(s.norms.one)}, {"2", json_number(s.norms.two)}}},
            {"norm_1_standard_error", json_number(s.one.error)},
            {"norm_1_part_of_measure", json_number(s.one.part)},
            {"spectral_radius", json_number(s.radius)},
            {"spectral_radius_shift", json_number(s.shift)},
            {"series", name(s.convergence)},
            {"eigenvalues", Json::array()},
            {"eigenvalues_converged", s.leading.converged},
            {"eigenvalues_search", {{"applications", s.leading.applications}, {"why", s.leading.why}}}};
        if (s.bounds) channel["spectral_radius_bounds"] = {s.bounds->low, json_number(s.bounds->high)};
        Json& history = channel["eigenvalues_search"]["history"] = Json::array();
        for (const EigenStep& step : s.leading.history)
            history.push_back({{"applications", step.applications}, {"residual", json_number(step.residual)}});
        for (const Eigenpair& pair : s.leading.pairs) {
            Json value = complex_json(pair.value);
            value["residual"] = pair.residual;
            channel["eigenvalues"].push_back(value);
        }
        if (s.by_slepc) {
            Json& slepc = channel["slepc"];
            slepc = {{"converged", s.by_slepc->converged},
                     {"why", s.by_slepc->why},
                     {"applications", s.by_slepc->applications},
                     {"eigenvalues", Json::array()}};
            for (const Eigenpair& pair : s.by_slepc->pairs) {
                Json value = complex_json(pair.value);
                value["residual"] = pair.residual;
                slepc["eigenvalues"].push_back(value);
            }
        }
        channel["refinement"] = Json::array();
        for (const RefinementRow& r : report.coarser) {
            Json leading = Json::array();
            for (const auto& value : r.leading[c]) leading.push_back(complex_json(value));
            channel["refinement"].push_back({{"what", r.what},
                                             {"patches", r.patches},
                                             {"unknowns", r.unknowns},
                                             {"rays", r.settings.rays},
                                             {"eigenvalues", leading}});
        }
        channel["bounces_until"] = Json::array();
        const bool converges = s.convergence == Convergence::converges;
        for (std::size_t i = 0; i < s.bounces.size(); ++i)
            channel["bounces_until"].push_back({{"remaining", SceneSpectrum::remaining[i]},
                                                {"bounces", report.emits && s.bounces[i] ? Json(*s.bounces[i]) : Json(nullptr)}});
        constexpr const char* formats[] = {"float", "double"};
        for (std::size_t i = 0; i < 2; ++i)
            channel["rounding"][formats[i]] = {{"relative_error", converges ? json_number(s.rounding[i]) : Json(nullptr)},
                                               {"sum_stops_at", converges ? json_number(s.stagnation[i]) : Json(nullptr)}};
        json["channels"].push_back(channel);
    }
    json["warnings"] = report.warnings;
    return json;
}

}  // namespace neumann
