# ifsi_kernel_options: how ifsi and whoever instantiates its kernels are compiled. They are part of the target's
# interface, since the width of a Pack follows from them.
include(CheckCXXCompilerFlag)

# Fused multiply-add and vector square roots are what the kernels live on; both keep IEEE rounding.
set(ifsi_kernel_options -ffp-contract=fast -fno-math-errno)
if(IFSI_NATIVE)
  foreach(option -march=native -mprefer-vector-width=512)
    string(MAKE_C_IDENTIFIER "IFSI_ACCEPTS${option}" accepted)
    check_cxx_compiler_flag(${option} ${accepted})
    if(${accepted})
      list(APPEND ifsi_kernel_options ${option})
    endif()
  endforeach()
endif()
