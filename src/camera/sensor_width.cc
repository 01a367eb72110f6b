// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "camera/picture_camera.h"

namespace ridgeline {
namespace {

struct Sensor {
  std::string_view model;  // as in the EXIF item "Model"
  double width_mm;
};

// From the makers' data sheets ("image sensor size"); where they name a format only, its nominal
// size: 1" 13.2 x 8.8, 4/3" 17.3 x 13.0, 1/2.3" 6.17 x 4.55 mm.
constexpr std::array kSensors = {
    Sensor{"Canon EOS 5D Mark II", 36.0},
    Sensor{"Canon EOS 5D Mark III", 36.0},
    Sensor{"Canon EOS 5D Mark IV", 36.0},
    Sensor{"Canon EOS 6D", 35.8},
    Sensor{"Canon EOS R", 36.0},
    Sensor{"Canon EOS R5", 36.0},
    Sensor{"Canon EOS R6", 35.9},
    Sensor{"Canon EOS 7D", 22.3},
    Sensor{"Canon EOS 60D", 22.3},
    Sensor{"Canon EOS 70D", 22.5},
    Sensor{"Canon EOS 80D", 22.3},
    Sensor{"Canon EOS 600D", 22.3},
    Sensor{"Canon EOS 650D", 22.3},
    Sensor{"Canon EOS 700D", 22.3},
    Sensor{"NIKON D600", 35.9},
    Sensor{"NIKON D750", 35.9},
    Sensor{"NIKON D800", 35.9},
    Sensor{"NIKON D810", 35.9},
    Sensor{"NIKON D850", 35.9},
    Sensor{"NIKON D3200", 23.2},
    Sensor{"NIKON D5300", 23.5},
    Sensor{"NIKON D7000", 23.6},
    Sensor{"NIKON D7100", 23.5},
    Sensor{"ILCE-6000", 23.5},
    Sensor{"ILCE-7", 35.8},
    Sensor{"ILCE-7R", 35.9},
    Sensor{"ILCE-7M3", 35.6},
    Sensor{"DSC-RX100", 13.2},
    Sensor{"FC300S", 6.17},
    Sensor{"FC300X", 6.17},
    Sensor{"FC330", 6.17},
    Sensor{"FC350", 6.17},
    Sensor{"FC220", 6.17},
    Sensor{"FC550", 17.3},
    Sensor{"FC6310", 13.2},
    Sensor{"FC6310S", 13.2},
    Sensor{"FC3411", 13.2},
    Sensor{"L1D-20c", 13.2},
};

}  // namespace

std::optional<double> SensorWidthMm(std::string_view model) {
  for (const Sensor& sensor : kSensors) {
    if (sensor.model == model) return sensor.width_mm;
  }
  return std::nullopt;
}

}  // namespace ridgeline
