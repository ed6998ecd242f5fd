// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Evaluates every spline of a layer, for splines.py: `tenon_sample_splines FILE TIME...` prints
// one line per attribute, its path and a value or "none" for every time.
#include <cstdio>
#include <cstdlib>

#include "tenon/base/text/text_number.h"
#include "tenon/formats/open_layer.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/time/spline.h"
#include "tenon/stage/values/evaluate_spline.h"

namespace {

using tenon::layer::Layer;

void print_samples(const tenon::layer::Spline& spline, tenon::Path path, int argc, char** argv) {
  std::printf("%s", path.str().c_str());
  for (int i = 2; i < argc; ++i) {
    const auto value = tenon::stage::evaluate_spline(spline, std::strtod(argv[i], nullptr));
    double number = 0;
    if (const auto* wide = value.get<double>()) {
      number = *wide;
    } else if (const auto* narrow = value.get<float>()) {
      number = static_cast<double>(*narrow);
    } else if (const auto* half = value.get<tenon::Half>()) {
      number = static_cast<double>(static_cast<float>(*half));
    } else if (const auto* time = value.get<tenon::layer::TimeCode>()) {
      number = time->value;
    }
    std::printf(" %s", value.empty() ? "none" : tenon::shortest(number).c_str());
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  tenon::Diagnostics diagnostics;
  const auto layer = tenon::formats::open_layer_file(argc > 1 ? argv[1] : "", diagnostics);
  if (!layer) {
    return 1;
  }
  for (const tenon::Token prim : Layer::children(layer->root(), "primChildren")) {
    const tenon::Path owner = tenon::Path::absolute_root().child(prim);
    for (const tenon::Token name : Layer::children(*layer->find(owner), "properties")) {
      const tenon::Path path = owner.property(name);
      const auto* spline =
          layer->find(path)->get<tenon::layer::Spline>(tenon::layer::fields::spline);
      if (spline != nullptr) {
        print_samples(*spline, path, argc, argv);
      }
    }
  }
  return 0;
}
