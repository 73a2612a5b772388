#pragma once

#include "io/hdf5_reader.h"
#include "io/hdf5_writer.h"
