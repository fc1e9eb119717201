# staffage-post: from passes and photograph to the dataset.
noinst_LIBRARIES += post/libpost.a
post_libpost_a_CPPFLAGS = $(AM_CPPFLAGS) $(OPENCV_CFLAGS) $(JANSSON_CFLAGS)
post_libpost_a_SOURCES =
POST_LIBS = post/libpost.a $(LIB_LIBS)
