# POV-Ray include files, one a subject, and the rules that users may edit.
templatesdir = $(pkgdatadir)/templates
dist_templates_DATA = \
  %D%/camera.inc %D%/ground.inc %D%/materials.inc %D%/materials.rules %D%/settings.inc %D%/shade.inc %D%/sky.inc %D%/sun.inc \
  %D%/pass_object.inc %D%/pass_plane.inc %D%/pass_shadow.inc %D%/receivers.inc
