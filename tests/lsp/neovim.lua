-- Repairs a first problem in a headless Neovim by the quick fixes of `rddl lsp`, and prints what it did as JSON.
--   nvim --headless -u NONE -c 'luafile neovim.lua'     with FOLDER and SETUP in the environment
local folder = vim.env.FOLDER
local names = { 'domain.rddl', 'instance.rddl' }
local published = {} -- by URI: version

local function fail(text)
  io.stderr:write(text .. '\n')
  vim.cmd('cquit 1')
end

local function wait(what, condition)
  if not vim.wait(60000, condition, 20) then fail('no ' .. what) end
end

local show = vim.lsp.handlers['textDocument/publishDiagnostics']
vim.lsp.handlers['textDocument/publishDiagnostics'] = function(err, result, ctx, config)
  show(err, result, ctx, config)
  published[result.uri] = result.version
end

dofile(vim.env.SETUP) -- the lines of editors/README.md

local buffers = {}
for _, name in ipairs(names) do
  vim.cmd('edit ' .. vim.fn.fnameescape(folder .. '/' .. name))
  local buffer = vim.api.nvim_get_current_buf()
  buffers[name] = buffer
end
local client_id = rddl_server
if not client_id then fail('the setup starts no server') end

local function diagnostics_of(buffer)
  local uri = vim.uri_from_bufnr(buffer)
  wait('diagnostics', function() return published[uri] and published[uri] == vim.lsp.util.buf_versions[buffer] end)
  local found = vim.diagnostic.get(buffer)
  table.sort(found, function(a, b)
    return a.lnum < b.lnum or (a.lnum == b.lnum and a.col < b.col)
  end)
  return found
end

local function request(buffer, method, params)
  local answers, why = vim.lsp.buf_request_sync(buffer, method, params, 60000)
  if not answers or not answers[client_id] or answers[client_id].err then fail(method .. ': ' .. vim.inspect(why or answers)) end
  return answers[client_id].result
end

local function next_step()
  for _, name in ipairs(names) do
    local buffer = buffers[name]
    for _, found in ipairs(diagnostics_of(buffer)) do
      local place = { line = found.lnum, character = found.col }
      local document = { uri = vim.uri_from_bufnr(buffer) }
      local actions = request(buffer, 'textDocument/codeAction', {
        textDocument = document, range = { start = place, ['end'] = place }, context = { diagnostics = {} } })
      if #actions == 0 then fail('no fix: ' .. found.message) end
      local hover = request(buffer, 'textDocument/hover', { textDocument = document, position = place })
      local client = vim.lsp.get_client_by_id(client_id)
      vim.lsp.util.apply_workspace_edit(actions[1].edit, client.offset_encoding)
      return { file = name, line = found.lnum + 1, code = actions[1].diagnostics[1].code, message = found.message,
               fix = actions[1].title, is_explained = hover.contents.value:find('# ' .. actions[1].diagnostics[1].code, 1, true) ~= nil }
    end
  end
end

local steps = {}
for _ = 1, 20 do
  local step = next_step()
  if not step then break end
  table.insert(steps, step)
end

-- Completion by Neovim's own omnifunc, rename and formatting by its own commands.
local domain = buffers['domain.rddl']
local function lines() return vim.api.nvim_buf_get_lines(domain, 0, -1, false) end
local repaired = {}
for _, name in ipairs(names) do
  repaired[name] = table.concat(vim.api.nvim_buf_get_lines(buffers[name], 0, -1, false), '\n') .. '\n'
end
vim.api.nvim_set_current_buf(domain)
local row = vim.fn.search('alive(?p) -')
vim.api.nvim_win_set_cursor(0, { row, vim.fn.col('.') })
local label = {}
for _, item in ipairs(request(domain, 'textDocument/completion', vim.lsp.util.make_position_params()).items) do
  label[item.label] = true
end
vim.lsp.buf.rename('living')
wait('rename', function() return table.concat(lines(), '\n'):find("living'(?p)", 1, true) end)
vim.lsp.buf_request_sync(domain, 'textDocument/formatting', vim.lsp.util.make_formatting_params(), 60000)
local clean = #diagnostics_of(domain) == 0 and #diagnostics_of(buffers['instance.rddl']) == 0
io.stdout:write(vim.json.encode({ steps = steps, repaired = repaired, completes = label['alive'] or false, clean_after_rename = clean }))
vim.lsp.stop_client(client_id)
vim.cmd('qall!')
