#include "core/reader/xml/instead_of.h"

#include <algorithm>
#include <array>

namespace neumann::reader {

namespace {

struct Plugin {
    std::string_view tag, type, advice;
};

constexpr std::string_view polarisation = "polarisation is not simulated; without it the picture needs no such plugin",
                           hair = "hair is not simulated", no_media = "media are not simulated, only surfaces",
                           all_paths = "'path' has the same picture", sky = "'sunsky' is the sky and the sun of one time of day";

constexpr std::array plugins = {
    Plugin{"animation", "", "nothing moves while a picture is taken"},
    Plugin{"bsdf", "circular", polarisation},
    Plugin{"bsdf", "difftrans", "'principledthin' with diff_trans lets light through diffusely"},
    Plugin{"bsdf", "hair", hair},
    Plugin{"bsdf", "hk", no_media},
    Plugin{"bsdf", "irawan", "woven cloth is not simulated"},
    Plugin{"bsdf", "measured", "measured materials are not read; 'principled' or 'roughconductor' can be fitted to them"},
    Plugin{"bsdf", "measured_polarized", polarisation},
    Plugin{"bsdf", "polarizer", polarisation},
    Plugin{"bsdf", "pplastic", "polarisation is not simulated; 'roughplastic' is the same without it"},
    Plugin{"bsdf", "retarder", polarisation},
    Plugin{"bsdf", "roughcoating", "'coating' is a smooth layer over any material, 'roughplastic' a rough one over a matt base"},
    Plugin{"bsdf", "roughdiffuse", "'diffuse' is the same for alpha 0; 'principled' has a matt base that is rough"},
    Plugin{"bsdf", "sssbrdf", no_media},
    Plugin{"emitter", "avg_sunsky", sky},
    Plugin{"emitter", "collimated", "a 'spot' of a narrow cone, or a 'directional' light, can stand for it"},
    Plugin{"emitter", "sky", "'sunsky' with sun_scale 0 is the sky alone"},
    Plugin{"emitter", "sun", "'sunsky' with sky_scale 0 is the sun alone"},
    Plugin{"emitter", "timed_sunsky", sky},
    Plugin{"emitter", "volumelight", no_media},
    Plugin{"film", "specfilm", "pictures are linear RGB; 'hdrfilm' is allowed"},
    Plugin{"integrator", "ao",
           "ambient occlusion is no light transport; 'path' in a 'constant' light and with white materials shows it"},
    Plugin{"integrator", "bdpt", all_paths},
    Plugin{"integrator", "depth", "it shows distances and no light; 'path' renders the scene"},
    Plugin{"integrator", "erpt", all_paths},
    Plugin{"integrator", "field", "it shows the geometry and no light; 'path' renders the scene"},
    Plugin{"integrator", "mlt", all_paths},
    Plugin{"integrator", "photonmapper", all_paths},
    Plugin{"integrator", "ppm", all_paths},
    Plugin{"integrator", "prb", all_paths},
    Plugin{"integrator", "prb_basic", all_paths},
    Plugin{"integrator", "prb_projective", all_paths},
    Plugin{"integrator", "prbvolpath", all_paths},
    Plugin{"integrator", "pssmlt", all_paths},
    Plugin{"integrator", "sppm", all_paths},
    Plugin{"integrator", "stokes", polarisation},
    Plugin{"integrator", "vpl", all_paths},
    Plugin{"medium", "", no_media},
    Plugin{"phase", "", no_media},
    Plugin{"sensor", "hdistant", "'distant' is the same for one direction; several of them can stand in a 'batch'"},
    Plugin{"shape", "ellipsoids", "splats are not read; a mesh, written as ply, can stand for them"},
    Plugin{"shape", "ellipsoidsmesh", "splats are not read; a mesh, written as ply, can stand for them"},
    Plugin{"shape", "hair", hair},
    Plugin{"shape", "heightfield", "a mesh, written as ply, can stand for it"},
    Plugin{"shape", "sdfgrid", "a mesh of its surface, written as ply, can stand for it"},
    Plugin{"subsurface", "", no_media},
    Plugin{"texture", "volume", no_media},
    Plugin{"volume", "", no_media},
};

}  // namespace

std::string_view instead_of(std::string_view tag, std::string_view type) {
    const auto found =
        std::find_if(plugins.begin(), plugins.end(), [&](const Plugin& p) { return p.tag == tag && p.type == type; });
    return found == plugins.end() ? std::string_view() : found->advice;
}

}  // namespace neumann::reader
