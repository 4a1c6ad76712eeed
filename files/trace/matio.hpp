// SPDX-License-Identifier: Apache-2.0
// libmatio, loaded when the first MAT file is asked for. Linked to the program, it and the HDF5 behind it
// took two thirds of the time that a short run takes as a whole.
#pragma once
#include <matio.h>

#include <string>

#include "files/rooms.hpp"
#include "sixstep/base/result.hpp"

namespace files {

/// The functions that are used, under their names less the "Mat_".
struct Matio {
  decltype(&::Mat_CreateVer) CreateVer = nullptr;
  decltype(&::Mat_Close) Close = nullptr;
  decltype(&::Mat_VarCreate) VarCreate = nullptr;
  decltype(&::Mat_VarCreateStruct) VarCreateStruct = nullptr;
  decltype(&::Mat_VarFree) VarFree = nullptr;
  decltype(&::Mat_VarSetStructFieldByName) VarSetStructFieldByName = nullptr;
  decltype(&::Mat_VarWrite) VarWrite = nullptr;
  decltype(&::Mat_VarWriteAppend) VarWriteAppend = nullptr;
};

/// A Problem where the library is not there or lacks a function; its `where` is left to whoever wants to
/// write.
base::Result<Matio> load_matio(const std::string& library);

/// The one that the program was compiled for, loaded once and for good.
const base::Result<Matio>& matio();

}  // namespace files
