;;; Repairs a first problem in Emacs by the quick fixes of `rddl lsp`, and prints what it did as JSON.
;;;   emacs --batch -l emacs.el     with FOLDER and SETUP in the environment
(package-initialize)
(require 'eglot)
(require 'json)
(load (getenv "SETUP") nil t) ; the lines of editors/README.md
(setq make-backup-files nil eglot-sync-connect t eglot-confirm-server-initiated-edits nil)

(defun fail (text) (princ text #'external-debugging-output) (kill-emacs 1))

(defvar published nil "The version of each URI whose diagnostics have come.")
(advice-add 'eglot-handle-notification :before
  (lambda (_ method &rest params)
    (when (eq method 'textDocument/publishDiagnostics)
      (setf (alist-get (plist-get params :uri) published nil nil #'equal)
            (cons (plist-get params :version) (plist-get params :diagnostics))))))

(defun ask (method &rest more)
  (eglot--signal-textDocument/didChange)
  (jsonrpc-request (eglot--current-server-or-lose) method
                   (append (list :textDocument (eglot--TextDocumentIdentifier)) more) :timeout 60))

(defun diagnostics ()
  "Those of the buffer as it is now, as the server sent them, in the order of their places."
  (eglot--signal-textDocument/didChange)
  (let ((uri (plist-get (eglot--TextDocumentIdentifier) :uri)) (end (+ (float-time) 60)) found)
    (while (not (equal (car (alist-get uri published nil nil #'equal)) eglot--versioned-identifier))
      (when (> (float-time) end) (fail "no diagnostics"))
      (accept-process-output nil 0.02))
    (setq found (append (cdr (alist-get uri published nil nil #'equal)) nil))
    (sort found (lambda (a b)
      (let ((x (plist-get (plist-get a :range) :start)) (y (plist-get (plist-get b :range) :start)))
        (or (< (plist-get x :line) (plist-get y :line))
            (and (= (plist-get x :line) (plist-get y :line))
                 (< (plist-get x :character) (plist-get y :character)))))))))

(defun repair (name found)
  "Makes the first quick fix of a diagnostic by Emacs' own edits."
  (let* ((place (plist-get (plist-get found :range) :start))
         (actions (ask :textDocument/codeAction :range (list :start place :end place)
                       :context (list :diagnostics [])))
         (hover (ask :textDocument/hover :position place))
         (action (if (> (length actions) 0) (aref actions 0) (fail (plist-get found :message))))
         (code (plist-get (aref (plist-get action :diagnostics) 0) :code)))
    (eglot--apply-workspace-edit (plist-get action :edit))
    `((file . ,name) (line . ,(1+ (plist-get place :line))) (code . ,code)
      (message . ,(plist-get found :message)) (fix . ,(plist-get action :title))
      (is_explained . ,(if (string-match-p (concat "# " code) (plist-get (plist-get hover :contents) :value))
                           t :json-false)))))

(defvar names '("domain.rddl" "instance.rddl"))
(defvar buffers (mapcar (lambda (name) (find-file-noselect (expand-file-name name (getenv "FOLDER")))) names))
(dolist (buffer buffers) (with-current-buffer buffer (unless (eq major-mode 'rddl-mode) (fail "no rddl-mode"))))
(with-current-buffer (car buffers) (call-interactively #'eglot))
(dolist (buffer buffers)
  (with-current-buffer buffer (unless (eglot-managed-p) (eglot--maybe-activate-editing-mode))
    (unless (eglot-managed-p) (fail "the server does not manage the file"))))

(defun next-step ()
  (catch 'done
    (cl-mapc (lambda (name buffer)
      (with-current-buffer buffer
        (let ((found (diagnostics))) (when found (throw 'done (repair name (car found)))))))
      names buffers)
    nil))

(defvar steps nil)
(let (step) (while (and (< (length steps) 20) (setq step (next-step))) (push step steps)))
(defun text-of (buffer) (with-current-buffer buffer (buffer-substring-no-properties (point-min) (point-max))))
(defvar repaired (cl-mapcar (lambda (name buffer) (cons (intern name) (text-of buffer))) names buffers))

;; What Emacs shows of the diagnostics, completion, rename and formatting, by Emacs' own commands.
(with-current-buffer (car buffers)
  (goto-char (point-min))
  (search-forward "alive(?p) -")
  (goto-char (match-beginning 0))
  (let* ((offer (eglot-completion-at-point)) (labels (all-completions "" (nth 2 offer)))
         (completes (if (member "alive" (mapcar #'substring-no-properties labels)) t :json-false)))
    (eglot-rename "living")
    (eglot-format-buffer)
    (let ((clean (and (string-match-p "living'(\\?p)" (text-of (car buffers)))
                      (cl-every (lambda (buffer) (with-current-buffer buffer (null (diagnostics)))) buffers))))
      (princ (json-encode `((steps . ,(vconcat (nreverse steps))) (repaired . ,repaired)
                            (completes . ,completes) (clean_after_rename . ,(if clean t :json-false))))))))
(dolist (buffer buffers) (with-current-buffer buffer (set-buffer-modified-p nil)))
(kill-emacs 0)
