// SPDX-License-Identifier: Apache-2.0
// Lists the scripts of a page, each after the scripts that it depends on.
#pragma once
#include <report_assets.hpp>
#include <string_view>
#include <vector>

namespace report {

/// Scripts of pages with charts over time: for one run, or for several compared runs.
inline std::vector<std::string_view> run_scripts() {
  return {assets::units_js(),       assets::curves_js(),  assets::chart_js(),  assets::rows_js(),
          assets::page_js(),        assets::instant_js(), assets::bridge_js(), assets::plane_js(),
          assets::instruments_js(), assets::spectra_js(), assets::report_js()};
}

}  // namespace report
