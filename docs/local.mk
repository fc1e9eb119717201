# docs
dist_doc_DATA = %D%/scene.md %D%/labels.md
