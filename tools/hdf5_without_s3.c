/* HDF5's driver for files in the cloud (S3) calls curl and OpenSSL, which bring 30 libraries. sandstroke opens no such
   files. In a program that contains HDF5, the driver calls these functions instead, and they fail. They are hidden, so
   that no other library calls them. */
#define FAILS(function, failure) \
  __attribute__((visibility("hidden"))) long function(void) { return failure; }

FAILS(curl_global_init, 2) /* CURLE_FAILED_INIT */
FAILS(curl_global_cleanup, 0)
FAILS(curl_easy_init, 0)
FAILS(curl_easy_setopt, 2)
FAILS(curl_easy_perform, 2)
FAILS(curl_easy_cleanup, 0)
FAILS(curl_slist_append, 0)
FAILS(curl_slist_free_all, 0)
FAILS(EVP_sha256, 0)
FAILS(HMAC, 0)
FAILS(SHA256, 0)
