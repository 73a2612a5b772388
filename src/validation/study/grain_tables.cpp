#include "validation/study/grain_strokes.h"

namespace sandstroke {

// The numbers are from sections.csv and forces.csv in tests/accuracy/grains.
const std::vector<GrainStroke> grain_strokes = {
    {"sphere, 2 mm deep",
     ToolShape::sphere,
     0.002,
     0.045,
     {-1.732e-3, -1.342e-3, -0.391e-3, 0.376e-3, 0.808e-3, 0.737e-3, 0.462e-3, 0.077e-3, 0.069e-3, 0.031e-3,
      0.010e-3, 0.005e-3, 0.006e-3, -0.002e-3},
     0.01386,
     0.02245},
    {"sphere, 4 mm deep",
     ToolShape::sphere,
     0.004,
     0.045,
     {-3.338e-3, -2.571e-3, -1.383e-3, -0.586e-3, 0.251e-3, 1.007e-3, 1.413e-3, 1.170e-3, 0.812e-3, 0.341e-3,
      0.135e-3, 0.063e-3, 0.020e-3, 0.015e-3},
     0.03430,
     0.04513},
    {"sphere, 6 mm deep",
     ToolShape::sphere,
     0.006,
     0.045,
     {-4.293e-3, -3.249e-3, -2.218e-3, -1.540e-3, -0.799e-3, 0.104e-3, 0.798e-3, 1.240e-3, 1.467e-3, 1.286e-3,
      0.697e-3, 0.378e-3, 0.146e-3, 0.069e-3},
     0.06016,
     0.06905},
    {"sphere plunged, 6 mm deep",
     ToolShape::sphere,
     0.006,
     0,
     {-5.136e-3, -4.400e-3, -3.121e-3, -1.442e-3, -0.271e-3, 0.503e-3, 0.814e-3, 0.801e-3, 0.599e-3, 0.383e-3,
      0.246e-3, 0.138e-3, 0.093e-3, 0.052e-3},
     0.00000,
     0.22960},
};

}  // namespace sandstroke
