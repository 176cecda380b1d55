#include "core/sensor/sensor.h"

namespace neumann {

Sensor::Sensor(const SensorOptions& options, const Film& film) : sensor_(make(options, film)), options_(options) {}

Sensor::Variant Sensor::make(const SensorOptions& options, const Film& film) {
    switch (options.kind) {
        case SensorOptions::Kind::perspective:
            break;
        case SensorOptions::Kind::thin_lens:
            return ThinLens(options, film);
        case SensorOptions::Kind::orthographic:
            return Orthographic(options, film);
    }
    return Perspective(options, film);
}

}  // namespace neumann
