#pragma once

#include "hdf5/hdf5_reader.h"
#include "hdf5/hdf5_writer.h"
