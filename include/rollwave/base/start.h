#pragma once

namespace rollwave {

/// Makes OpenBLAS take its buffer of 128 MiB before other memory is used if the address space is
/// limited (ulimit -v), since OpenBLAS waits for ever where there is no room later.
/// @return false if the buffer does not fit
bool take_blas_buffer();

} // namespace rollwave
