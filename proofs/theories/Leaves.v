(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The leaves of identities [IDN-1], kind by kind as in src/stream/algebra/ring.h: the meaning of each, its relation,
   and that the relation holds. A polynomial in leaves that is a combination of their relations is 0. *)
From Coq Require Import Reals Lra Lia ZArith NArith List Ring_polynom Bool.
From Dyadel Require Import Identity.
From Dyadel Require Export CheckerCycle.
Open Scope R_scope.

(* ---- integer polynomials in one variable, as in CheckerCycle.v ---- *)

Fixpoint at_ (f : poly) (x : R) : R :=
  match f with nil => 0 | c :: g => IZR c + x * at_ g x end.

Lemma at_scale c f x : at_ (scale c f) x = IZR c * at_ f x.
Proof. induction f as [| d f IH]; simpl; [ring |]. rewrite IH, mult_IZR. ring. Qed.

Lemma at_plus f g x : at_ (plus f g) x = at_ f x + at_ g x.
Proof.
  revert g. induction f as [| c f IH]; intros [| d g]; simpl; try ring. rewrite IH, plus_IZR. ring.
Qed.

Lemma at_times f g x : at_ (times f g) x = at_ f x * at_ g x.
Proof. induction f as [| c f IH]; simpl; [ring |]. rewrite at_plus, at_scale. simpl. rewrite IH. ring. Qed.

Lemma at_null f x : is_null f = true -> at_ f x = 0.
Proof.
  induction f as [| c f IH]; simpl; [reflexivity |]. intros E. apply andb_prop in E as [C E].
  apply Z.eqb_eq in C. subst c. rewrite (IH E). ring.
Qed.

(* ---- 2 cos (2 pi / N) ---- *)

Lemma chebyshev_pair k t : at_ (fst (chebyshev k)) (2 * cos t) = 2 * cos (INR k * t) /\
  at_ (snd (chebyshev k)) (2 * cos t) = 2 * cos (INR (S k) * t).
Proof.
  induction k as [| k [A B]].
  - simpl. rewrite Rmult_0_l, cos_0, Rmult_1_l. split; ring.
  - cbn [chebyshev]. destruct (chebyshev k) as [a b]. cbn [fst snd] in *. split; [exact B |].
    rewrite at_plus, at_scale. cbn [at_]. rewrite A, B.
    set (u := INR (S k) * t). replace (INR k * t) with (u - t) by (unfold u; rewrite S_INR; ring).
    replace (INR (S (S k)) * t) with (u + t) by (unfold u; rewrite (S_INR (S k)); ring).
    rewrite cos_minus, cos_plus. ring.
Qed.

Theorem chebyshev_cosine k t : at_ (fst (chebyshev k)) (2 * cos t) = 2 * cos (INR k * t).
Proof. apply chebyshev_pair. Qed.

Definition turn (n : nat) : R := 2 * cos (2 * PI / INR n).

Lemma closes_turn k n : (0 < n)%nat -> at_ (closes k) (turn n) = 2 * cos (INR k / INR n * (2 * PI)) - 2.
Proof.
  intros P. unfold closes, turn. rewrite at_plus, chebyshev_cosine. simpl (at_ ((-2)%Z :: nil) _).
  replace (INR k * (2 * PI / INR n)) with (INR k / INR n * (2 * PI)) by (field; apply not_0_INR; lia). ring.
Qed.

Lemma cos_below_one a : 0 < a < 2 * PI -> cos a < 1.
Proof.
  intros A. replace a with (2 * (a / 2)) by field. rewrite cos_2a_sin.
  assert (S : 0 < sin (a / 2)) by (apply sin_gt_0; lra).
  assert (0 < sin (a / 2) * sin (a / 2)) by (now apply Rmult_lt_0_compat). lra.
Qed.

(* Not before the n-th. *)
Lemma closes_late d n : (0 < d < n)%nat -> at_ (closes d) (turn n) <> 0.
Proof.
  intros D. rewrite closes_turn by lia. assert (0 < INR n) by (apply lt_0_INR; lia).
  assert (0 < INR d) by (apply lt_0_INR; lia). assert (INR d < INR n) by (apply lt_INR; lia).
  assert (Q : 0 < INR d / INR n < 1).
  { split; [now apply Rdiv_lt_0_compat |]. apply (Rmult_lt_reg_r (INR n)); [assumption |].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
  pose proof PI_RGT_0. pose proof (cos_below_one (INR d / INR n * (2 * PI))).
  assert (0 < INR d / INR n * (2 * PI) < 2 * PI).
  { split; [apply Rmult_lt_0_compat; lra |]. rewrite <- (Rmult_1_l (2 * PI)) at 2. apply Rmult_lt_compat_r; lra. }
  lra.
Qed.

Lemma closes_now n : (0 < n)%nat -> at_ (closes n) (turn n) = 0.
Proof.
  intros P. rewrite closes_turn by exact P. replace (INR n / INR n * (2 * PI)) with (2 * PI);
    [rewrite cos_2PI; ring |]. field. apply not_0_INR. lia.
Qed.

Lemma all_close_late l n : (forall d, In d l -> (0 < d < n)%nat) -> at_ (all_close l) (turn n) <> 0.
Proof.
  intros A. induction l as [| d l IH]; [simpl; lra |]. unfold all_close. simpl. rewrite at_times.
  apply divisors_nonzero; [apply closes_late, A; now left | apply IH; intros e E; apply A; now right].
Qed.

Theorem cycle_zero n f earlier quotient : is_cycle n f earlier quotient = true -> at_ f (turn n) = 0.
Proof.
  intros E. apply andb_prop in E as [E Null]. apply andb_prop in E as [P L]. apply Nat.ltb_lt in P.
  assert (Ls : forall d, In d earlier -> (0 < d < n)%nat).
  { intros d D. rewrite forallb_forall in L. specialize (L d D). apply andb_prop in L as [A B].
    apply Nat.ltb_lt in A, B. lia. }
  apply (at_null _ (turn n)) in Null. rewrite at_plus, at_scale, !at_times, (closes_now n P) in Null.
  assert (Z : at_ f (turn n) * at_ f (turn n) * at_ (all_close earlier) (turn n) = 0) by lra.
  apply Rmult_integral in Z as [Z | Z]; [| now elim (all_close_late earlier n Ls)].
  now apply Rmult_integral in Z as [Z | Z].
Qed.



(* So the relation of the cycle holds: computed for these N, the premise of cycle_zero for others. *)
Theorem psi_zero n : (1 <= n <= 100)%nat -> at_ (psi n) (turn n) = 0.
Proof.
  intros P. assert (A : forallb cycle_is_psi (seq 1 100) = true) by (vm_compute; reflexivity).
  rewrite forallb_forall in A. specialize (A n). rewrite in_seq in A.
  apply (cycle_zero n (psi n) _ _ (A ltac:(lia))).
Qed.

(* All cosines of multiples of the part of the turn are polynomials in the one. *)
Theorem cosine_of_part k n : (0 < n)%nat -> 2 * cos (INR k / INR n * (2 * PI)) = at_ (fst (chebyshev k)) (turn n).
Proof.
  intros P. unfold turn. rewrite chebyshev_cosine. f_equal. f_equal. field. apply not_0_INR. lia.
Qed.

(* ---- square roots, cube roots ---- *)

Definition root (k : nat) (a x : R) : Prop := x ^ k = a /\ (Nat.Even k -> 0 <= x).

Lemma power_less k x y : (0 < k)%nat -> 0 <= x < y -> x ^ k < y ^ k.
Proof.
  intros K [X Y]. induction k as [| k IH]; [lia |]. destruct k as [| k]; [simpl; lra |].
  specialize (IH ltac:(lia)). change (x * x ^ S k < y * y ^ S k).
  assert (0 <= x ^ S k) by (now apply pow_le).
  apply Rle_lt_trans with (x * y ^ S k); [apply Rmult_le_compat_l; lra | apply Rmult_lt_compat_r; lra].
Qed.

Lemma power_opposite k x : Nat.Odd k -> (- x) ^ k = - x ^ k.
Proof.
  intros [j ->]. rewrite Nat.add_1_r. change (- x * (- x) ^ (2 * j) = - (x * x ^ (2 * j))). rewrite !pow_mult.
  replace ((- x) ^ 2) with (x ^ 2) by ring. ring.
Qed.

(* There is one root: the number that has the power, and is not negative where that is required. *)
Theorem root_unique k a x y : (0 < k)%nat -> root k a x -> root k a y -> x = y.
Proof.
  intros K [X Px] [Y Py].
  assert (Less : forall u v, u ^ k = v ^ k -> (Nat.Even k -> 0 <= u) -> (Nat.Even k -> 0 <= v) -> ~ u < v).
  { intros u v E U V L. destruct (Nat.Even_or_Odd k) as [Ev | Od].
    - pose proof (power_less k u v K (conj (U Ev) L)). lra.
    - destruct (Rle_dec 0 u) as [P | P]; [pose proof (power_less k u v K (conj P L)); lra |].
      destruct (Rle_dec v 0) as [Q | Q].
      + pose proof (power_less k (- v) (- u) K ltac:(lra)) as G. rewrite !power_opposite in G by exact Od. lra.
      + pose proof (pow_lt v k ltac:(lra)). pose proof (pow_lt (- u) k ltac:(lra)) as G.
        rewrite power_opposite in G by exact Od. lra. }
  rewrite <- Y in X. destruct (Rtotal_order x y) as [L | [E | L]]; [| exact E |].
  - exfalso. now apply (Less x y X).
  - exfalso. now apply (Less y x (eq_sym X)).
Qed.

Theorem root_exists k a : (0 < k)%nat -> 0 <= a \/ Nat.Odd k -> exists x, root k a x.
Proof.
  assert (Pos : forall b, (0 < k)%nat -> 0 <= b -> exists x, 0 <= x /\ x ^ k = b).
  { intros b K B. destruct (Req_dec b 0) as [-> | D].
    - exists 0. split; [lra |]. apply pow_i, K.
    - exists (Rpower b (/ INR k)). assert (0 < Rpower b (/ INR k)) by (unfold Rpower; apply exp_pos). split; [lra |].
      rewrite <- Rpower_pow by assumption. rewrite Rpower_mult, Rinv_l by (apply not_0_INR; lia). apply Rpower_1. lra. }
  intros K H. destruct (Rle_dec 0 a) as [A | A].
  - destruct (Pos a K A) as [x [X E]]. exists x. split; [exact E | auto].
  - destruct H as [H | H]; [contradiction |]. destruct (Pos (- a) K ltac:(lra)) as [x [X E]]. exists (- x).
    split; [rewrite power_opposite, E by exact H; ring |]. intros Ev. exfalso. destruct Ev as [i Ei], H as [j Ej]. lia.
Qed.

(* What radicals are made of: products over a base, factors taken out, signs, denominators. *)
Theorem root_product k a b x y : root k a x -> root k b y -> root k (a * b) (x * y).
Proof.
  intros [X P] [Y Q]. split; [rewrite Rpow_mult_distr, X, Y; reflexivity |]. intros E. apply Rmult_le_pos; auto.
Qed.

Theorem root_factor k c a x : 0 <= c -> root k a x -> root k (c ^ k * a) (c * x).
Proof.
  intros C [X P]. split; [rewrite Rpow_mult_distr, X; reflexivity |]. intros E. apply Rmult_le_pos; auto.
Qed.

Theorem root_negative k a x : Nat.Odd k -> root k a x -> root k (- a) (- x).
Proof.
  intros O [X P]. split; [rewrite power_opposite, X by exact O; reflexivity |].
  intros [i Ei]. destruct O as [j Ej]. lia.
Qed.

Theorem root_fraction k m d x : (0 < k)%nat -> 0 < d -> root k (m * d ^ (k - 1)) x -> root k (m / d) (x / d).
Proof.
  intros K D [X P]. split.
  - unfold Rdiv. rewrite Rpow_mult_distr, X, pow_inv. replace (d ^ k) with (d * d ^ (k - 1)).
    + assert (d ^ (k - 1) <> 0) by (apply pow_nonzero; lra). field. split; [lra | assumption].
    + destruct k; [lia |]. simpl. now rewrite Nat.sub_0_r.
  - intros E. apply Rmult_le_pos; [auto |]. left. now apply Rinv_0_lt_compat.
Qed.

(* ---- roots of polynomials ---- *)

(* a^(n-1) f(t / a) for f of degree n with leading coefficient a: monic, 0 at t = a r where f(r) = 0. *)
Fixpoint powers (a : Z) (f : poly) : poly :=
  match f with nil => nil | c :: g => (c * a ^ Z.of_nat (length g))%Z :: powers a g end.
Definition monic (f : poly) (a : Z) : poly := powers a f ++ (1%Z :: nil).

Lemma at_app f g x : at_ (f ++ g) x = at_ f x + x ^ length f * at_ g x.
Proof. induction f as [| c f IH]; simpl; [ring |]. rewrite IH. ring. Qed.

Lemma powers_length a f : length (powers a f) = length f.
Proof. induction f as [| c f IH]; simpl; [reflexivity | now rewrite IH]. Qed.

Lemma at_powers a f x : IZR a * at_ (powers a f) (IZR a * x) = IZR a ^ length f * at_ f x.
Proof.
  induction f as [| c f IH]; simpl; [ring |]. rewrite mult_IZR, <- pow_IZR.
  rewrite Rmult_plus_distr_l. replace (IZR a * (IZR a * x * at_ (powers a f) (IZR a * x)))
    with (IZR a * x * (IZR a * at_ (powers a f) (IZR a * x))) by ring. rewrite IH. ring.
Qed.

Theorem monic_root f a r : a <> 0%Z -> f <> nil -> at_ (f ++ (a :: nil)) r = 0 -> at_ (monic f a) (IZR a * r) = 0.
Proof.
  intros A F E. assert (A' : IZR a <> 0) by (apply not_0_IZR, A).
  apply (Rmult_eq_reg_l (IZR a)); [| exact A']. rewrite Rmult_0_r. unfold monic. rewrite at_app, powers_length.
  rewrite Rmult_plus_distr_l, at_powers, Rpow_mult_distr. simpl (at_ (1%Z :: nil) _).
  rewrite at_app in E. simpl (at_ (a :: nil) r) in E.
  transitivity (IZR a ^ length f * (at_ f r + r ^ length f * (IZR a + r * 0))); [simpl; ring | rewrite E; ring].
Qed.

(* Of the factors of f only one may be 0 at the root, the others are seen not to be: it is. *)
Theorem own_factor f g l r : at_ f r = 0 -> (forall x, at_ f x = at_ g x * fold_right (fun h y => at_ h x * y) 1 l) ->
  (forall h, In h l -> at_ h r <> 0) -> at_ g r = 0.
Proof.
  intros F E O. rewrite E in F. apply Rmult_integral in F as [F | F]; [exact F | exfalso]. revert F.
  change (fold_right (fun h y => at_ h r * y) 1 l <> 0).
  clear E. induction l as [| h l IH]; simpl; [lra |].
  apply divisors_nonzero; [apply O; now left | apply IH; intros k K; apply O; now right].
Qed.

(* Degree 2, by the side of the middle on which the root is. *)
Theorem quadratic a b c r : a <> 0 -> a * (r * r) + b * r + c = 0 ->
  exists s, root 2 (b * b - 4 * a * c) s /\ (0 <= 2 * a * r + b -> r = (- b + s) / (2 * a)) /\
    (2 * a * r + b <= 0 -> r = (- b - s) / (2 * a)).
Proof.
  intros A E. exists (Rabs (2 * a * r + b)). split; [| split].
  - split; [| intros _; apply Rabs_pos]. rewrite pow2_abs.
    transitivity (b * b - 4 * a * c + 4 * a * (a * (r * r) + b * r + c)); [ring | rewrite E; ring].
  - intros P. rewrite Rabs_pos_eq by exact P. field. exact A.
  - intros P. rewrite Rabs_left1 by exact P. field. exact A.
Qed.

(* ---- exponentials ---- *)

Theorem exponential_of_opposite u : exp (- u) = / exp u.
Proof. apply exp_Ropp. Qed.

Theorem hyperbolic u : sinh u = (exp u - / exp u) / 2 /\ cosh u = (exp u + / exp u) / 2 /\
  tanh u = (exp u - / exp u) / (exp u + / exp u) /\ exp u + / exp u <> 0.
Proof.
  assert (P : 0 < exp u + / exp u) by (pose proof (exp_pos u); pose proof (Rinv_0_lt_compat _ H); lra).
  unfold tanh, sinh, cosh. rewrite exp_Ropp. repeat split; [| lra]. field. split; [apply Rgt_not_eq, exp_pos |].
  pose proof (exp_pos u). assert (0 < exp u * exp u) by (now apply Rmult_lt_0_compat). lra.
Qed.

(* ---- towers of leaves ---- *)

(* Leaf n of a tower is PEX n. RADICAL and NESTED: the k-th root of an expression in leaves before; CYCLE; ROOT: a times
   a zero of f ++ [a]; SIN: the sine, after its cosine. *)
Inductive kind : Type :=
| Radical (k : nat) (of : expression)
| Cycle (n : nat) (minimal : poly)
| Root (f : poly) (a : Z)
| Cosine
| Sine
| Free.

Fixpoint in_leaf (f : poly) (x : expression) : expression :=
  match f with nil => PEc 0%Z | c :: g => PEadd (PEc c) (PEmul x (in_leaf g x)) end.

Definition relation (n : positive) (l : kind) : expression :=
  match l with
  | Radical k of => PEsub (PEpow (PEX Z n) (N.of_nat k)) of
  | Cycle _ f => in_leaf f (PEX Z n)
  | Root f a => in_leaf (monic f a) (PEX Z n)
  | Sine => PEsub (PEadd (PEpow (PEX Z n) 2) (PEpow (PEX Z (Pos.pred n)) 2)) (PEc 1%Z)
  | Cosine | Free => PEc 0%Z
  end.

Definition is_leaf (leaf : list R) (n : positive) (l : kind) : Prop :=
  let x := value leaf (PEX Z n) in
  match l with
  | Radical k of => root k (value leaf of) x
  | Cycle m f => x = turn m /\ exists earlier quotient, is_cycle m f earlier quotient = true
  | Root f a => a <> 0%Z /\ f <> nil /\ exists r, at_ (f ++ (a :: nil)) r = 0 /\ x = IZR a * r
  | Sine => exists u, value leaf (PEX Z (Pos.pred n)) = cos u /\ x = sin u
  | Cosine | Free => True
  end.

Lemma value_in_leaf leaf f x : value leaf (in_leaf f x) = at_ f (value leaf x).
Proof.
  induction f as [| c f IH]; [reflexivity |]. simpl in_leaf. simpl at_. rewrite <- IH. reflexivity.
Qed.

Theorem relation_holds leaf n l : is_leaf leaf n l -> value leaf (relation n l) = 0.
Proof.
  destruct l as [k of | m f | f a | | |]; cbv zeta beta iota delta [is_leaf relation].
  - intros [E _]. change (value leaf (PEX Z n) ^ N.to_nat (N.of_nat k) - value leaf of = 0). rewrite Nat2N.id.
    apply Rminus_diag_eq. exact E.
  - intros [E [earlier [quotient C]]]. rewrite value_in_leaf, E. now apply cycle_zero with earlier quotient.
  - intros [A [F [r [E X]]]]. rewrite value_in_leaf, X. now apply monic_root.
  - reflexivity.
  - intros [u [C S]].
    change (value leaf (PEX Z n) ^ 2 + value leaf (PEX Z (Pos.pred n)) ^ 2 - 1 = 0). rewrite C, S.
    pose proof (cosine_sine u). simpl. lra.
  - reflexivity.
Qed.

(* P = q_1 f_1 + q_2 f_2 + ...: what any way of dividing by the relations shows that ends with the remainder 0. *)
Definition combination (l : list (expression * expression)) : expression :=
  fold_right (fun e sum => PEadd (PEmul (fst e) (snd e)) sum) (PEc 0%Z) l.

Theorem combination_zero leaf P l : (forall q f, In (q, f) l -> value leaf f = 0) ->
  same (normal 0 nil P) (normal 0 nil (combination l)) = true -> value leaf P = 0.
Proof.
  intros H E. rewrite (identity 0 nil leaf P (combination l) Logic.I E). clear E.
  induction l as [| [q f] l IH]; [reflexivity |].
  change (value leaf q * value leaf f + value leaf (combination l) = 0).
  rewrite (H q f) by now left. rewrite IH; [ring |]. intros q' f' F. apply (H q' f'). now right.
Qed.

(* The whole: leaves that are what their kinds say, a fraction whose denominator is not 0, and a numerator that their
   relations reduce to 0. *)
Theorem tower_zero leaf (tower : list (positive * kind)) P Q quotients :
  (forall n l, In (n, l) tower -> is_leaf leaf n l) -> value leaf Q <> 0 ->
  (forall q f, In (q, f) quotients -> exists n l, In (n, l) tower /\ f = relation n l) ->
  same (normal 0 nil P) (normal 0 nil (combination quotients)) = true -> value leaf P / value leaf Q = 0.
Proof.
  intros L D F E. apply fraction_zero; [exact D |]. apply combination_zero with quotients; [| exact E].
  intros q f K. destruct (F q f K) as [n [l [T ->]]]. now apply relation_holds, L.
Qed.

(* For instance: 2 cos(2 pi / 12) is the square root of 3. x^2 - 3 is the relation of both, so their difference, times
   their sum, is 0. *)
Example twelve leaf : is_leaf leaf 1 (Cycle 12 (psi 12)) -> is_leaf leaf 2 (Radical 2 (PEc 3%Z)) ->
  value leaf (PEsub (PEpow (PEX Z 1) 2) (PEpow (PEX Z 2) 2)) = 0.
Proof.
  intros C S. apply (combination_zero leaf _
    ((PEc 1%Z, relation 1 (Cycle 12 (psi 12))) :: (PEc (-1)%Z, relation 2 (Radical 2 (PEc 3%Z))) :: nil)).
  - intros q f [E | [E | []]]; apply (f_equal snd) in E; cbn [snd] in E; rewrite <- E; now apply relation_holds.
  - vm_compute. reflexivity.
Qed.
