# The manual. tests/man.sh holds it against what the programs say themselves.
dist_man1_MANS += %D%/staffage.1 %D%/staffage-fuse.1 %D%/staffage-gen.1 %D%/staffage-import.1 %D%/staffage-models.1 %D%/staffage-post.1 %D%/staffage-povray.1 %D%/staffage-stats.1
dist_man5_MANS = %D%/staffage-scene.5
